// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace vericone::fitting::fit_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A closed two-lobed mesh of revolution, made skew: no symmetry is left.
Sample lobes() {
  const int rings = 23, sides = 20;
  Sample mesh;
  const auto add = [&](double x, double y, double z) {
    mesh.points.emplace_back(x + 0.02 * y * y + 0.013, 1.1 * y + 0.03 * x * z,
                             0.9 * z + 0.02 * x + 0.01 * x * x);
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double t = M_PI * (i + 1) / (rings + 1), a = 2 * M_PI * j / sides;
      const double r = std::sin(t) * (0.3 + 0.7 * std::cos(t) * std::cos(t));
      add(-2 * std::cos(t), r * std::cos(a), r * std::sin(a));
    }
  const auto at = [&](int i, int j) { return std::uint32_t(i * sides + j % sides); };
  const std::uint32_t first = std::uint32_t(rings * sides), last = first + 1;
  add(-2, 0, 0);
  add(2, 0, 0);
  for (int j = 0; j < sides; ++j) {
    mesh.triangles.push_back({first, at(0, j), at(0, j + 1)});
    mesh.triangles.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
    for (int i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

Sample cloud_of(Sample mesh) {
  mesh.triangles.clear();
  return mesh;
}

FitOptions containing(Shape shape) {
  FitOptions options;
  options.shape = shape;
  return options;
}

void expect_same(const FitResult& a, const FitResult& b, const Matrix3d& turn, const Vector3d& shift,
                 double scale, double tolerance) {
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t k = 0; k < a.pieces.size(); ++k) {
    const CombinedEllipsoid &p = a.pieces[k].body, &q = b.pieces[k].body;
    const double size = p.ellipsoid().semi_axes()(0);
    EXPECT_LT((scale * (turn * p.center() + shift) - q.center()).norm(), tolerance * scale * size);
    const Matrix3d expected = scale * scale * turn * p.ellipsoid().shape() * turn.transpose();
    EXPECT_LT((expected - q.ellipsoid().shape()).norm(), tolerance * expected.norm());
    ASSERT_EQ(p.delimiters().size(), q.delimiters().size());
    for (std::size_t i = 0; i < p.delimiters().size(); ++i) {
      const Matrix3d form = turn * p.delimiters()[i].matrix * turn.transpose() / (scale * scale);
      EXPECT_LT((form / p.delimiters()[i].level - q.delimiters()[i].matrix / q.delimiters()[i].level).norm(),
                tolerance * form.norm());
    }
  }
  // The volume of a union is sampled.
  ASSERT_TRUE(a.volume && b.volume);
  EXPECT_NEAR(b.volume->value / (a.volume->value * scale * scale * scale), 1,
              a.pieces.size() == 1 ? tolerance : 1e-5);
}

void expect_equivariant(const Sample& sample, const FitOptions& options,
                        std::initializer_list<double> scales = {1e-3, 1.0, 1e3}) {
  const FitResult first = fit(sample, options);
  const Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d(1, 2, -0.7).normalized()).toRotationMatrix();
  const Vector3d shift(3, -4, 2);
  for (const double scale : scales) {
    SCOPED_TRACE(scale);
    Sample moved = sample;
    for (Vector3d& x : moved.points) x = scale * (turn * x + shift);
    expect_same(first, fit(moved, options), turn, shift, scale, 1e-9);
  }
}

TEST(Fit, ContainingEllipsoidsAreEquivariant) { expect_equivariant(lobes(), containing(Shape::ellipsoid)); }
TEST(Fit, ContainingWaistsAreEquivariant) { expect_equivariant(lobes(), containing(Shape::biconvex)); }
TEST(Fit, ContainingDentsAreEquivariant) { expect_equivariant(lobes(), containing(Shape::biconcave)); }

TEST(Fit, SeveralPiecesAreEquivariant) {
  for (const Sample& sample : {lobes(), cloud_of(lobes())}) {
    FitOptions options = containing(Shape::ellipsoid);
    options.pieces = 3;
    expect_equivariant(sample, options);
  }
}

TEST(Fit, MarginsAreEquivariant) {
  FitOptions options = containing(Shape::ellipsoid);
  Sample flat = cloud_of(lobes());
  for (Vector3d& x : flat.points) x.z() *= 1e-3;
  const Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d(1, 2, -0.7).normalized()).toRotationMatrix();
  const Vector3d shift(3, -4, 2);
  options.margin = 0.1;
  const FitResult first = fit(flat, options);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    Sample moved = flat;
    for (Vector3d& x : moved.points) x = scale * (turn * x + shift);
    options.margin = 0.1 * scale;
    expect_same(first, fit(moved, options), turn, shift, scale, 1e-9);
  }
}

TEST(Fit, StarsAreEquivariant) { expect_equivariant(lobes(), containing(Shape::star), {1e3}); }

TEST(Fit, CoverageIsEquivariant) {
  FitOptions options = containing(Shape::biconvex);
  options.coverage = 0.9;
  expect_equivariant(cloud_of(lobes()), options);
}

/// The vertical is the world's: footprints turn about it.
TEST(Fit, FootprintsAreEquivariant) {
  const Sample sample = lobes();
  const FitResult first = fit(sample, containing(Shape::ellipse));
  const Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d shift(3, -4, 2);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    Sample moved = sample;
    for (Vector3d& x : moved.points) x = scale * (turn * x + shift);
    const FitResult other = fit(moved, containing(Shape::ellipse));
    const Ellipse &p = *first.pieces[0].footprint, &q = *other.pieces[0].footprint;
    const Eigen::Matrix2d flat = turn.topLeftCorner<2, 2>();
    EXPECT_LT((scale * (flat * p.center() + shift.head<2>()) - q.center()).norm(), 1e-9 * scale);
    EXPECT_LT((scale * scale * flat * p.shape() * flat.transpose() - q.shape()).norm(),
              1e-9 * scale * scale * p.shape().norm());
    EXPECT_NEAR(other.pieces[0].high, scale * (first.pieces[0].high + shift.z()), 1e-9 * scale);
  }
}

TEST(Fit, DoesNotDependOnTheOrderOfPointsAndTriangles) {
  const Sample mesh = lobes();
  Sample shuffled;
  std::vector<std::uint32_t> order(mesh.points.size()), place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::mt19937_64 engine(3);
  std::shuffle(order.begin(), order.end(), engine);
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    shuffled.points.push_back(mesh.points[order[i]]);
    place[order[i]] = i;
  }
  for (const auto& t : mesh.triangles) shuffled.triangles.push_back({place[t[1]], place[t[2]], place[t[0]]});
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), engine);
  for (const Shape shape : {Shape::ellipsoid, Shape::biconvex}) {
    const FitResult a = fit(mesh, containing(shape)), b = fit(shuffled, containing(shape));
    ASSERT_EQ(a.pieces[0].quadrics.size(), b.pieces[0].quadrics.size());
    for (std::size_t i = 0; i < a.pieces[0].quadrics.size(); ++i)
      EXPECT_EQ(a.pieces[0].quadrics[i].matrix(), b.pieces[0].quadrics[i].matrix());
  }
}

TEST(Fit, ContainingHullsAreProved) {
  const Sample mesh = lobes();
  for (const Shape shape : {Shape::ellipse, Shape::ellipsoid, Shape::biconcave, Shape::biconvex}) {
    const FitResult result = fit(mesh, containing(shape));
    EXPECT_TRUE(result.certified) << to_string(shape);
    EXPECT_EQ(result.certificate.points_inside, mesh.points.size());
    EXPECT_EQ(result.certificate.triangles_inside, mesh.triangles.size());
    EXPECT_LT(result.inflation, 1 + 1e-9);
    if (shape != Shape::ellipse) {
      EXPECT_LE(result.volume->value, *result.ellipsoid_volume * (1 + 1e-9));
      EXPECT_GT(result.volume->value, *result.scan_volume);
    }
  }
}

TEST(Fit, PiecesContainTogether) {
  for (const Sample& sample : {lobes(), cloud_of(lobes())}) {
    FitOptions options = containing(Shape::ellipsoid);
    options.pieces = 2;
    const FitResult result = fit(sample, options);
    EXPECT_EQ(result.pieces.size(), 2u);
    EXPECT_TRUE(result.certified);
    EXPECT_LT(result.volume->value, 0.8 * *result.ellipsoid_volume);
  }
}

TEST(Fit, CoverageLeavesOutliersOut) {
  Sample sample = cloud_of(lobes());
  const double clean = fit(sample, containing(Shape::ellipsoid)).volume->value;
  sample.points.emplace_back(40, 3, 2);
  const FitResult all = fit(sample, containing(Shape::ellipsoid));
  EXPECT_GT(all.volume->value, 3 * clean);
  ASSERT_FALSE(all.notes.empty());
  EXPECT_NE(all.notes.front().find("(40, 3, 2)"), std::string::npos) << all.notes.front();
  FitOptions options = containing(Shape::ellipsoid);
  options.coverage = 0.99;
  const FitResult most = fit(sample, options);
  EXPECT_LE(most.volume->value, clean);
  EXPECT_TRUE(most.certified);
  EXPECT_GE(most.certificate.coverage(), 0.99);
  EXPECT_LT(most.certificate.points_inside, sample.points.size());
}

/// Points near an ellipsoid, by a twentieth.
Sample near_ellipsoid() {
  Sample sample;
  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 400; ++i) {
    const Vector3d u = Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
    sample.points.push_back((1 + 0.05 * normal(engine)) * Vector3d(3 * u.x(), 2 * u.y(), u.z()));
  }
  return sample;
}

TEST(Fit, SurfacesAreInflatedToTheirCoverage) {
  FitOptions options;
  options.mode = Mode::least_squares;
  options.shape = Shape::ellipsoid;
  const FitResult near = fit(near_ellipsoid(), options);
  EXPECT_FALSE(near.certified);
  EXPECT_LT(near.certificate.points_inside, near.certificate.points);
  options.coverage = 0.9;
  const FitResult most = fit(near_ellipsoid(), options);
  EXPECT_TRUE(most.certified);
  EXPECT_GE(most.certificate.coverage(), 0.9);
  EXPECT_GT(most.inflation, 1);
  options.coverage = 1;
  EXPECT_GT(fit(near_ellipsoid(), options).volume->value, most.volume->value);
}

TEST(Fit, TheChoiceIsExplained) {
  const FitResult result = fit(lobes(), {});
  EXPECT_EQ(result.candidates.size(), 4u);
  EXPECT_NE(result.shape, Shape::ellipsoid);  // the waist is worth its parameters
  EXPECT_NE(result.why.find("biconvex"), std::string::npos) << result.why;
  Sample ball;
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 3000; ++i)
    ball.points.push_back(Vector3d(normal(engine), normal(engine), normal(engine)).normalized());
  const FitResult chosen = fit(ball, {});
  EXPECT_EQ(chosen.shape, Shape::ellipsoid);  // the points are dense: nothing to cut away
  // What cannot be chosen is not followed to the end: dents and a waist that take away too little, a star.
  EXPECT_EQ(chosen.candidates.size(), 3u);
  EXPECT_EQ(chosen.volume->value, fit(ball, containing(Shape::ellipsoid)).volume->value);
}

/// Of the outer part of a long ellipsoid: its ends lie where even directions do not look.
TEST(Fit, LongSurfacesThatGoOnBeyondTheirPointsAreRefused) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (const Mode mode : {Mode::least_squares, Mode::robust}) {
    FitOptions options = containing(Shape::ellipsoid);
    options.mode = mode;
    for (const double from : {0.45, -1.0}) {
      Sample sample;
      while (sample.points.size() < 600) {
        const Vector3d u = Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
        if (u.x() > from)
          sample.points.push_back(Vector3d(2, 0.1, 0.1).cwiseProduct(u) * (1 + 0.002 * normal(engine)));
      }
      if (from > 0)
        EXPECT_THROW((void)fit(sample, options), InputError);
      else
        EXPECT_NEAR(fit(sample, options).pieces[0].body.ellipsoid().semi_axes().maxCoeff(), 2, 0.1);
    }
  }
}

TEST(Fit, CanBeInterrupted) {
  FitOptions options;
  int calls = 0;
  options.progress = [&](const std::string&, double) { return ++calls < 3; };
  EXPECT_THROW(fit(lobes(), options), Interrupted);
}

TEST(Fit, RefusesWithTheFieldNamed) {
  const auto field = [](const Sample& sample, const std::function<void(FitOptions&)>& change) {
    FitOptions options;
    change(options);
    try {
      fit(sample, options);
      return std::string("accepted");
    } catch (const InputError& e) {
      return e.field();
    }
  };
  const Sample cloud = cloud_of(lobes());
  EXPECT_EQ(field(cloud, [](FitOptions& o) { o.coverage = 0; }), "coverage");
  EXPECT_EQ(field(cloud, [](FitOptions& o) { o.coverage = std::nan(""); }), "coverage");
  EXPECT_EQ(field(cloud, [](FitOptions& o) { o.coverage = 1.5; }), "coverage");
  EXPECT_EQ(field(cloud, [](FitOptions& o) { o.margin = -1; }), "margin");
  EXPECT_EQ(field(cloud, [](FitOptions& o) { o.pieces = 0; }), "pieces");
  EXPECT_EQ(field(cloud, [](FitOptions& o) { o.pieces = 65; }), "pieces");
  EXPECT_EQ(field(cloud,
                  [](FitOptions& o) {
                    o.mode = Mode::robust;
                    o.margin = 0.1;
                  }),
            "margin");
  Sample few;
  few.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(field(few, [](FitOptions&) {}), "points");
  few.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  EXPECT_EQ(field(few, [](FitOptions&) {}), "points");  // in a plane
  few.points.emplace_back(0, 0, 1);
  EXPECT_EQ(field(few, [](FitOptions&) {}), "accepted");
  EXPECT_EQ(field(few, [](FitOptions& o) { o.shape = Shape::biconcave; }), "points");
  EXPECT_EQ(field(few, [](FitOptions& o) { o.mode = Mode::least_squares; }), "points");
}

// A cap of a long body: the rest would be invented.
TEST(Fit, RefusesWhatThePointsDoNotDetermine) {
  Sample cap;
  for (int i = 0; i < 60; ++i)
    for (int k = 0; k < 40; ++k) {
      const double turn = 0.1047 * i, out = 0.012 * k, noise = 0.004 * ((i * 37 + k * 101) % 7 - 3);
      const double height = 3 * std::sqrt(1 - out * out) + noise;
      cap.points.emplace_back(out * std::cos(turn), out * std::sin(turn), height);
    }
  for (const Mode mode : {Mode::robust, Mode::least_squares}) {
    FitOptions options;
    options.mode = mode;
    options.shape = Shape::ellipsoid;
    try {
      const FitResult result = fit(cap, options);
      FAIL() << result.pieces.front().body.ellipsoid().semi_axes().transpose();
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("not determined by these points"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace vericone::fitting::fit_test
