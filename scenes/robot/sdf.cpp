// SPDX-License-Identifier: BSD-3-Clause
//
// SDF (sdformat.org/spec): models with their links, poses between named frames. Whole sizes, metres and
// radians; cylinders and capsules about z and about their middle, a capsule's length between the centres of
// its ends.
#include <vericone/geometry/body.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <deque>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "robot/robot.h"

namespace vericone::robot {
namespace {

using Eigen::Vector3d;

std::string shown_name(const std::string& text) { return text.substr(0, 40); }

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// In any case, as libsdformat takes it.
bool truth_of(const std::string& text, int line, const char* what) {
  std::string word = trimmed(text);
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word == "true" || word == "1") return true;
  if (word != "false" && word != "0") refuse(line, what + (" \"" + shown_name(text)) + "\"", "true or false");
  return false;
}

/// The x of SDF 1.x: what an axis is written in depends on it.
int version_of(const Element& root) {
  const std::string text = trimmed(needed(root, "version"));
  const bool of_one = text.starts_with("1.") && text.size() > 2 && text.size() < 6;
  if (!of_one || text.find_first_not_of("0123456789", 2) != std::string::npos)
    refuse(root.line, "version \"" + shown_name(text) + "\"", "1.0 to 1.12, or a later 1.x");
  return std::stoi(text.substr(2));
}

/// Of a <pose>, of nothing where there is none.
Pose pose_of(const Element* element) {
  Pose pose;
  if (const std::string* frame = element ? element->attribute("frame") : nullptr; frame && !frame->empty())
    refuse(element->line, "frame=\"" + shown_name(*frame) + "\"", "relative_to, of SDF 1.7 and later");
  if (!element || trimmed(element->text).empty()) return pose;
  const std::string* format = element->attribute("rotation_format");
  if (format && *format == "quat_xyzw") {
    const auto x = vector_of<7>(element->text, element->line, "pose");
    const Eigen::Vector4d q(x(6), x(3), x(4), x(5));
    if (!(std::abs(q.stableNorm() - 1) < 1e-6))
      refuse(element->line, "a quaternion of another length", "one of length 1");
    pose.position = x.head<3>();
    pose.rotation = rotation_3d(q);
    return pose;
  }
  if (format && *format != "euler_rpy") refuse(element->line, shown_name(*format), "euler_rpy or quat_xyzw");
  const auto x = vector_of<6>(element->text, element->line, "pose");
  const std::string* degrees = element->attribute("degrees");
  const double unit = degrees && truth_of(*degrees, element->line, "degrees") ? std::numbers::pi / 180 : 1;
  pose.position = x.head<3>();
  pose.rotation = turn_of(unit * x.tail<3>());
  return pose;
}

/// Named frames of a model, each in another.
class Frames {
 public:
  void add(const std::string& name, const std::string& in, const Pose& pose, int line) {
    if (!frames_.emplace(name, Frame{in, pose, line}).second)
      refuse(line, shown_name(name), "a name that no other link, joint or frame of the model has");
  }
  /// In the model's frame.
  Pose at(const std::string& name, int line) const {
    Pose pose;
    std::string at = name;
    for (std::size_t steps = 0; !at.empty() && at != "__model__"; ++steps) {
      const auto found = frames_.find(at);
      if (found == frames_.end())
        refuse(line, shown_name(at), "the name of a link, a joint or a frame of the model");
      if (steps > frames_.size())
        refuse(line, shown_name(name), "frames that are not relative to each other in a circle");
      pose = steps == 0 ? found->second.pose : composed(found->second.pose, pose);
      line = found->second.line;
      at = found->second.in;
    }
    return pose;
  }

 private:
  struct Frame {
    std::string in;
    Pose pose;
    int line;
  };
  std::map<std::string, Frame> frames_;
};

/// The frame that a pose is written in.
std::string relative_to(const Element& owner, const std::string& otherwise) {
  const Element* pose = owner.child("pose");
  const std::string* given = pose ? pose->attribute("relative_to") : nullptr;
  return given && !given->empty() ? *given : otherwise;
}

double size_in(const Element& shape, const char* name) {
  const Element& size = needed_child(shape, name);
  return size_of(size.text, size.line, name);
}

Geometry sdf_geometry(const Element& owner) {
  Geometry result;
  const Element& geometry = needed_child(owner, "geometry");
  if (geometry.children.size() != 1)
    refuse(geometry.line, "<geometry> of " + std::to_string(geometry.children.size()), "one shape");
  const Element& shape = geometry.children.front();
  const auto sizes = [&](const char* name) {
    const Element& size = needed_child(shape, name);
    const Vector3d x = vector_of<3>(size.text, size.line, name);
    if (!(x.array() >= 0).all()) refuse(size.line, std::string(name) + " below 0", "0 or more (metres)");
    return x;
  };
  if (shape.name == "box") {
    result.body = Convex::box(0.5 * sizes("size"));
  } else if (shape.name == "sphere") {
    result.body = Convex::capsule(size_in(shape, "radius"), 0).called("ball");
  } else if (shape.name == "cylinder") {
    result.body = Convex::cylinder(size_in(shape, "radius"), size_in(shape, "length"));
  } else if (shape.name == "capsule") {
    result.body = Convex::capsule(size_in(shape, "radius"), size_in(shape, "length"));
  } else if (shape.name == "cone") {
    result.body = Convex::cone(size_in(shape, "radius"), size_in(shape, "length"));
  } else if (shape.name == "ellipsoid") {
    const Vector3d radii = sizes("radii");
    if (!(radii.array() > 0).all()) refuse(shape.line, "a radius of 0", "positive radii (metres)");
    result.body = Convex::rounded(Ellipsoid::from_axes(Vector3d::Zero(), radii), 0).called("ellipsoid");
  } else if (shape.name == "mesh") {
    if (shape.child("submesh")) refuse(shape.line, "<submesh>", "left out: the whole file");
    const Element& uri = needed_child(shape, "uri");
    result.mesh = {trimmed(uri.text), Vector3d::Ones(), uri.line};
    if (const Element* scale = shape.child("scale"))
      result.mesh.scale = vector_of<3>(scale->text, scale->line, "scale");
  } else if (shape.name == "plane") {
    result.mesh.line = shape.line;
    result.plane = Vector3d::UnitZ();
    if (const Element* normal = shape.child("normal"))
      result.plane = unit_axis(vector_of<3>(normal->text, normal->line, "normal"), normal->line);
  } else {
    refuse(shape.line, "<" + shown_name(shape.name) + ">",
           "box, sphere, cylinder, capsule, cone, ellipsoid, plane or mesh");
  }
  return result;
}

class SdfModel {
 public:
  SdfModel(const Element& model, int version, Shown shown, Robot& robot, const std::string& prefix,
           const Pose& place)
      : model_(model), version_(version), shown_(shown), robot_(robot), prefix_(prefix), place_(place) {}

  void read() {
    for (const char* other : {"model", "include"})
      if (const Element* nested = model_.child(other))
        refuse(nested->line, std::string("<") + other + "> in a model",
               "a model with its links: no model in another");
    if (model_.attribute("placement_frame"))
      refuse(model_.line, "placement_frame", "left out: the model's pose is that of its own frame");
    add_frames();
    for (const Element& element : model_.children)
      if (element.name == "link") add_link(element);
    for (const Element& element : model_.children)
      if (element.name == "joint") add_joint(element);
  }

 private:
  void add_frames() {
    for (const Element& element : model_.children) {
      const bool link = element.name == "link", joint = element.name == "joint",
                 frame = element.name == "frame";
      if (!link && !joint && !frame) continue;
      std::string in = "__model__";
      if (joint) in = trimmed(needed_child(element, "child").text);
      if (const std::string* attached = element.attribute("attached_to"); frame && attached) in = *attached;
      frames_.add(needed(element, "name"), relative_to(element, in), pose_of(element.child("pose")),
                  element.line);
    }
  }

  void add_link(const Element& element) {
    Link link;
    const std::string& name = needed(element, "name");
    const Pose own = frames_.at(name, element.line);
    link.name = prefix_ + name;
    link.rest = composed(place_, own);
    for (const Element& part : element.children) {
      if (part.name != (shown_ == Shown::collision ? "collision" : "visual")) continue;
      Geometry geometry = sdf_geometry(part);
      const std::string in = relative_to(part, name);
      geometry.pose = pose_of(part.child("pose"));
      if (in != name)
        geometry.pose = composed(inverse(own), composed(frames_.at(in, part.line), geometry.pose));
      link.geometries.push_back(std::move(geometry));
    }
    numbers_.emplace(name, robot_.links.size());
    robot_.links.push_back(std::move(link));
  }

  std::size_t link_of(const Element& joint, const char* role) {
    const Element& named = needed_child(joint, role);
    const std::string name = trimmed(named.text);
    if (const auto found = numbers_.find(name); found != numbers_.end()) return found->second;
    if (name != "world" || std::string(role) != "parent")
      refuse(named.line, shown_name(name), "the name of a link");
    numbers_.emplace(name, robot_.links.size());
    robot_.links.push_back({prefix_ + "world", {}, Pose()});
    return robot_.links.size() - 1;
  }

  void add_joint(const Element& element) {
    Joint joint;
    joint.line = element.line;
    joint.name = prefix_ + needed(element, "name");
    joint.type = needed(element, "type");
    const char* const kinds[] = {"fixed",     "revolute", "continuous", "prismatic", "ball",
                                 "universal", "screw",    "revolute2",  "gearbox"};
    if (std::find(std::begin(kinds), std::end(kinds), joint.type) == std::end(kinds))
      refuse(element.line, "type \"" + shown_name(joint.type) + "\"", "a type of joint");
    joint.parent = link_of(element, "parent");
    joint.child = link_of(element, "child");
    const Pose own = frames_.at(needed(element, "name"), element.line), in_world = composed(place_, own);
    joint.origin = composed(inverse(*robot_.links[joint.parent].rest), in_world);
    joint.child_in = composed(inverse(in_world), *robot_.links[joint.child].rest);
    if (const Element* axis = element.child("axis"); axis && joint.moves()) add_axis(*axis, own, joint);
    robot_.joints.push_back(std::move(joint));
  }

  /// multiplier * (the other's value - reference) + offset.
  Joint::Mimic mimic_of(const Element& element) const {
    const std::string* axis = element.attribute("axis");
    if (axis && *axis != "axis") refuse(element.line, shown_name(*axis), "axis: joints of two are at rest");
    const auto number = [&](const char* name, double otherwise) {
      const Element* given = element.child(name);
      return given ? numbers(given->text, 1, given->line, name).front() : otherwise;
    };
    Joint::Mimic mimic;
    mimic.joint = prefix_ + needed(element, "joint");
    mimic.line = element.line;
    mimic.multiplier = number("multiplier", 1);
    mimic.offset = number("offset", 0) - mimic.multiplier * number("reference", 0);
    return mimic;
  }

  void add_axis(const Element& axis, const Pose& own, Joint& joint) const {
    joint.axis = Vector3d::UnitZ();  // as SDF says
    if (const Element* mimic = axis.child("mimic")) joint.mimic = mimic_of(*mimic);
    const Element* xyz = axis.child("xyz");
    const int line = xyz ? xyz->line : axis.line;
    if (xyz) joint.axis = unit_axis(vector_of<3>(xyz->text, line, "xyz"), line);
    const std::string* in = xyz ? xyz->attribute("expressed_in") : nullptr;
    const Element* old = axis.child("use_parent_model_frame");
    // Up to SDF 1.4 always (libsdformat, sdf/1.5/1_4.convert).
    const bool asked = old && truth_of(old->text, old->line, "use_parent_model_frame");
    if ((in && !in->empty()) || version_ < 5 || asked) {
      const Pose frame = frames_.at(in && !in->empty() ? *in : "__model__", line);
      joint.axis = own.rotation.transpose() * (frame.rotation * joint.axis);
      joint.axis /= joint.axis.norm();
    }
    const Element* limit = axis.child("limit");
    if (!limit || joint.type == "continuous") return;
    for (const auto& [name, end] : {std::pair("lower", &joint.lower), std::pair("upper", &joint.upper)})
      if (const Element* given = limit->child(name)) {
        const std::string text = trimmed(given->text);
        if (text != "inf" && text != "-inf") *end = numbers(text, 1, given->line, name).front();
      }
  }

  const Element& model_;
  int version_;
  Shown shown_;
  Robot& robot_;
  std::string prefix_;
  Pose place_;
  Frames frames_;
  std::map<std::string, std::size_t> numbers_;
};

/// The models of a file, of its worlds too, and those of files that it includes.
class SdfModels {
 public:
  SdfModels(Shown shown, const Include& include) : shown_(shown), include_(include) {}

  Robot read(const Element& root) {
    const int version = version_of(root);
    gather(root, version, nullptr);
    for (const Element& world : root.children)
      if (world.name == "world") gather(world, version, nullptr);
    if (models_.empty()) refuse(root.line, "no model", "one model or more");
    Robot robot;
    std::set<std::string> names;
    for (const Model& one : models_) {
      if (!names.insert(one.name).second)
        refuse(one.line, shown_name(one.name), "a name that no other model has");
      const std::size_t links = robot.links.size(), joints = robot.joints.size();
      in_file(one, [&] {
        const std::string prefix = models_.size() > 1 ? one.name + "::" : "";
        SdfModel(*one.model, one.version, shown_, robot, prefix, one.place).read();
      });
      if (!one.file) continue;
      for (std::size_t i = links; i < robot.links.size(); ++i)
        for (Geometry& geometry : robot.links[i].geometries) {
          geometry.mesh.folder = one.file->folder;
          geometry.mesh.line = one.line;
        }
      for (std::size_t i = joints; i < robot.joints.size(); ++i) {
        robot.joints[i].line = one.line;
        if (robot.joints[i].mimic) robot.joints[i].mimic->line = one.line;
      }
    }
    return robot;
  }

 private:
  struct Model {
    const Element* model;
    int version;
    std::string name;
    Pose place;
    int line;                  // of the file itself
    const IncludedFile* file;  // null: the file itself
    std::string uri;
  };

  /// What is wrong in a file that is included is said of the line that includes it.
  template <typename Read>
  static void in_file(const Model& one, const Read& read) {
    try {
      read();
    } catch (const InputError& e) {
      if (!one.file) throw;
      refuse(one.line, shown_name(one.uri) + ", " + e.field() + ": " + e.value(), e.requirement());
    }
  }

  static Pose place_of(const Element& owner) {
    if (const std::string in = relative_to(owner, "world"); in != "world")
      refuse(owner.child("pose")->line, "relative_to " + shown_name(in),
             "left out: models stand in the world");
    return pose_of(owner.child("pose"));
  }

  void gather(const Element& owner, int version, const Model* including) {
    for (const Element& element : owner.children) {
      if (element.name == "model") {
        Model model{&element, version, needed(element, "name"), place_of(element), element.line, nullptr, ""};
        if (including) {
          model.line = including->line;
          model.file = including->file;
          model.uri = including->uri;
        }
        models_.push_back(std::move(model));
      }
      if (element.name == "include") {
        if (including) refuse(element.line, "<include>", "models that stand in the included file itself");
        add_included(element);
      }
    }
  }

  void add_included(const Element& element) {
    const Element& uri = needed_child(element, "uri");
    if (const Element* other = element.child("placement_frame"))
      refuse(other->line, "<placement_frame>", "left out: the pose is that of the model's own frame");
    Model one{nullptr, 0, "", Pose(), element.line, nullptr, trimmed(uri.text)};
    one.file = &files_.emplace_back(include_(one.uri, uri.line));
    const std::size_t before = models_.size();
    in_file(one, [&] {
      const Element& root = one.file->root;
      if (root.name != "sdf") refuse(root.line, "<" + shown_name(root.name) + ">", "<sdf>");
      gather(root, version_of(root), &one);
      if (models_.size() != before + 1)
        refuse(root.line, std::to_string(models_.size() - before) + " models", "one model");
    });
    if (const Element* name = element.child("name")) models_.back().name = trimmed(name->text);
    if (element.child("pose")) models_.back().place = place_of(element);
  }

  Shown shown_;
  const Include& include_;
  std::deque<IncludedFile> files_;
  std::vector<Model> models_;
};

}  // namespace

Robot read_sdf(const Element& root, Shown shown, const Include& include) {
  return SdfModels(shown, include).read(root);
}

}  // namespace vericone::robot
