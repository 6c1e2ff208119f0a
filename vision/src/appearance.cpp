// SPDX-License-Identifier: BSD-3-Clause
#include "appearance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace vericone::vision {
namespace {

constexpr int kMostAcross = 36;     // samples along the longer side: more cost time and gain nothing
constexpr double kMargin = 0.15;    // of the size, on each side: the target's edge against the ground
constexpr double kLeastMargin = 2;  // px
constexpr double kMarginWeight = 0.15;
constexpr double kNoise = 4;            // grey levels: what no camera's and no codec's pixel stays within
constexpr double kFirstVariance = 100;  // grey levels squared, before anything is known of a pixel
constexpr double kLeastContrast = 2;    // grey levels
constexpr double kTogether = 0.3;       // neighbouring samples that tell the same thing twice
constexpr int kRounds = 12;
constexpr double kAgree = 0.6;  // of the contrast: a pixel further off is another thing's
constexpr float kOutside = -1;  // of a sample beyond the picture

}  // namespace

Appearance::Appearance(const cv::Mat& grey, const View& view, const Eigen::Vector2d& size) : size_(size) {
  // One sample a pixel of this picture, or fewer of a large target.
  const Eigen::Vector2d whole = size + 2 * (kMargin * size).cwiseMax(kLeastMargin / view.scale);
  step_ = std::max(1 / view.scale, whole.maxCoeff() / kMostAcross);
  across_ = std::max(4, int(std::ceil(whole.x() / step_)));
  down_ = std::max(4, int(std::ceil(whole.y() / step_)));
  for (int j = 0; j < down_; ++j)
    for (int i = 0; i < across_; ++i) {
      const double x = (i - 0.5 * (across_ - 1)) * step_, y = (j - 0.5 * (down_ - 1)) * step_;
      x_.push_back(float(x));
      y_.push_back(float(y));
      // The corners of a box are more often the ground's than the middle is.
      const double u = 2 * x / size.x(), v = 2 * y / size.y(), r = u * u + v * v;
      const bool in = std::abs(u) <= 1 && std::abs(v) <= 1;
      taper_.push_back(float(in ? std::max(0.4, 1 - 0.3 * r) : kMarginWeight));
    }
  sample(grey, view, mean_);
  for (float& value : mean_) value = std::max(value, 0.f);
  variance_.assign(mean_.size(), float(kFirstVariance));
  weigh();
}

void Appearance::sample(const cv::Mat& grey, const View& view, std::vector<float>& values) const {
  values.resize(x_.size());
  const float c = float(view.scale * std::cos(view.turn)), s = float(view.scale * std::sin(view.turn));
  const float cx = float(view.centre.x()), cy = float(view.centre.y());
  const float right = float(grey.cols - 1), bottom = float(grey.rows - 1);
  const std::size_t stride = grey.step;
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const float u = cx + c * x_[k] - s * y_[k], v = cy + s * x_[k] + c * y_[k];
    if (!(u >= 0 && v >= 0 && u < right && v < bottom)) {
      values[k] = kOutside;
      continue;
    }
    const int i = int(u), j = int(v);
    const float fu = u - float(i), fv = v - float(j);
    const std::uint8_t* p = grey.data + std::size_t(j) * stride + i;
    const float top = float(p[0]) + fu * (float(p[1]) - float(p[0]));
    const float low = float(p[stride]) + fu * (float(p[stride + 1]) - float(p[stride]));
    values[k] = top + fv * (low - top);
  }
}

void Appearance::weigh() {
  const std::size_t n = mean_.size();
  weight_.resize(n);
  slope_x_.resize(n);
  slope_y_.resize(n);
  double sum = 0, level = 0, square = 0;
  for (std::size_t k = 0; k < n; ++k) {
    weight_[k] = taper_[k] * float(kFirstVariance / (kFirstVariance + variance_[k]));
    sum += weight_[k];
    level += weight_[k] * mean_[k];
  }
  level_ = level / sum;
  for (std::size_t k = 0; k < n; ++k) square += weight_[k] * std::pow(mean_[k] - level_, 2);
  contrast_ = std::max(kLeastContrast, std::sqrt(square / sum));
  const auto at = [&](int i, int j) {
    return mean_[std::clamp(j, 0, down_ - 1) * across_ + std::clamp(i, 0, across_ - 1)];
  };
  for (int j = 0; j < down_; ++j)
    for (int i = 0; i < across_; ++i) {
      const float x = at(i + 1, j) - at(i - 1, j), y = at(i, j + 1) - at(i, j - 1);
      const float wide = (i == 0 || i == across_ - 1) ? 1.f : 2.f,
                  high = (j == 0 || j == down_ - 1) ? 1.f : 2.f;
      slope_x_[j * across_ + i] = x / (wide * float(step_));
      slope_y_[j * across_ + i] = y / (high * float(step_));
    }
}

Agreement Appearance::judge(const std::vector<float>& values, double gain, double bias) const {
  Agreement result;
  result.gain = gain;
  result.bias = bias;
  double all = 0, in = 0, agree = 0, mv = 0, mm = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    all += weight_[k];
    if (values[k] == kOutside) continue;
    in += weight_[k];
    mv += weight_[k] * values[k];
    mm += weight_[k] * mean_[k];
  }
  if (!(in > 0)) return result;
  mv /= in;
  mm /= in;
  double vv = 0, ww = 0, vm = 0;
  double close = 0, cv = 0, cm = 0, cvv = 0, cmm = 0, cvm = 0;  // of those that agree closely
  const double limit = kAgree * gain * contrast_;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] == kOutside) continue;
    const double v = values[k] - mv, m = mean_[k] - mm;
    vv += weight_[k] * v * v;
    ww += weight_[k] * m * m;
    vm += weight_[k] * v * m;
    const double far = std::abs(values[k] - gain * mean_[k] - bias);
    if (far < std::max(limit, 3.0 * std::sqrt(double(variance_[k])) * gain * 0.5 + kNoise))
      agree += weight_[k];
    if (far > std::max(limit, kNoise)) continue;  // of a faint target everything plain is within its noise
    close += weight_[k];
    cv += weight_[k] * v;
    cm += weight_[k] * m;
    cvv += weight_[k] * v * v;
    cmm += weight_[k] * m * m;
    cvm += weight_[k] * v * m;
  }
  const double floor = in * kLeastContrast * kLeastContrast;
  result.correlation = vm / std::sqrt(std::max(vv, floor) * std::max(ww, floor));
  result.alike = result.correlation;
  result.inside = in / all;
  result.visible = agree / all;
  if (close > 0) {
    const double least = floor * close / in;
    const double of_close = (cvm - cv * cm / close) / std::sqrt(std::max(cvv - cv * cv / close, least) *
                                                                std::max(cmm - cm * cm / close, least));
    result.alike = std::max(result.alike, close / all * of_close);
  }
  return result;
}

Agreement Appearance::compare(const cv::Mat& grey, const View& view) const {
  std::vector<float> values;
  sample(grey, view, values);
  // Gain and bias by least squares on what is there.
  double sw = 0, sv = 0, sm = 0, smm = 0, svm = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] == kOutside) continue;
    const double w = weight_[k], m = mean_[k] - level_;
    sw += w;
    sv += w * values[k];
    sm += w * m;
    smm += w * m * m;
    svm += w * m * values[k];
  }
  if (!(sw > 0)) return {};
  const double det = sw * smm - sm * sm;
  const double gain = det > 0 ? std::clamp((sw * svm - sm * sv) / det, 0.3, 3.0) : 1;
  const double bias = (sv - gain * sm) / sw - gain * level_;
  return judge(values, gain, bias);
}

Agreement Appearance::align(const cv::Mat& grey, View& view, const Form* form) const {
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  std::vector<float> values;
  double gain = 1, bias = 0, spread = 0;
  const double radius = 0.5 * size_.norm();
  for (int round = 0; round < kRounds; ++round) {
    sample(grey, view, values);
    if (round == 0) {
      // Light changes little from picture to picture: a median is not moved by what covers a part.
      std::vector<float> off;
      for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k] != kOutside) off.push_back(values[k] - mean_[k]);
      if (off.size() < values.size() / 4) return judge(values, 1, 0);
      std::nth_element(off.begin(), off.begin() + off.size() / 2, off.end());
      bias = off[off.size() / 2];
    }
    // Geman and McClure's weights: those far off count for nothing. The width narrows from the contrast.
    spread = std::max(kNoise, (round < 4 ? 1.0 : 0.6) * gain * contrast_);
    Matrix a = Matrix::Zero();
    Vector b = Vector::Zero();
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (values[k] == kOutside) continue;
      const double r = values[k] - gain * mean_[k] - bias, q = r / spread, f = 1 / (1 + q * q);
      const double w = weight_[k] * f * f, x = x_[k], y = y_[k], gx = slope_x_[k], gy = slope_y_[k];
      const double row[6] = {gx, gy, x * gy - y * gx, x * gx + y * gy, mean_[k] - level_, 1};
      for (int i = 0; i < 6; ++i) {
        const double wi = w * row[i];
        for (int j = i; j < 6; ++j) a(i, j) += wi * row[j];
        b(i) += wi * values[k];
      }
    }
    a.triangularView<Eigen::StrictlyLower>() = a.transpose();
    if (form) {
      const double noise = kTogether * spread * spread;
      const auto hold = [&](int i, double off, double deviation) {
        const double k = noise / std::pow(gain * deviation, 2);
        a(i, i) += k;
        b(i) += k * gain * off;
      };
      hold(2, view.turn - form->view.turn, form->turn);
      hold(3, std::log(view.scale / form->view.scale), form->scale);
    } else {
      for (const int i : {2, 3}) {
        a.row(i).setZero();
        a.col(i).setZero();
        a(i, i) = 1;
        b(i) = 0;
      }
    }
    for (int i = 0; i < 6; ++i) a(i, i) += 1e-6 * a(i, i) + 1e-9;
    const Vector p = a.ldlt().solve(b);
    if (!p.allFinite()) break;
    gain = std::clamp(p(4), 0.3, 3.0);
    bias = p(5) - gain * level_;
    // The picture shows at q what the grid has at q + move: the view goes back by it.
    const double most = std::max(1.0, 0.2 * radius);
    Eigen::Vector2d move(p(0) / gain, p(1) / gain);
    if (move.norm() > most) move *= most / move.norm();
    const double turn = form ? std::clamp(p(2) / gain, -0.1, 0.1) : 0,
                 grow = form ? std::clamp(p(3) / gain, -0.1, 0.1) : 0;
    const double c = std::cos(view.turn), s = std::sin(view.turn);
    view.centre -= view.scale * Eigen::Vector2d(c * move.x() - s * move.y(), s * move.x() + c * move.y());
    view.turn -= turn;
    view.scale *= 1 - grow;
    if (round >= 4 && move.norm() < 0.01 && radius * (std::abs(turn) + std::abs(grow)) < 0.02) break;
  }
  sample(grey, view, values);
  return judge(values, gain, bias);
}

void Appearance::learn(const cv::Mat& grey, const View& view, double rate) {
  std::vector<float> values;
  sample(grey, view, values);
  const Agreement fit = compare(grey, view);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] == kOutside) continue;
    const double now = (values[k] - fit.bias) / fit.gain, off = now - mean_[k];
    mean_[k] += float(rate * off);
    variance_[k] += float(rate * (off * off - variance_[k]));
  }
  weigh();
}

cv::Mat Appearance::picture() const {
  cv::Mat result(down_, across_, CV_8U);
  for (int k = 0; k < across_ * down_; ++k) result.data[k] = cv::saturate_cast<std::uint8_t>(mean_[k]);
  return result;
}

}  // namespace vericone::vision
