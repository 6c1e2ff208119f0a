// SPDX-License-Identifier: BSD-3-Clause
//
// Robots from URDF and SDF: against closed forms of where their links are, against each other, against bodies
// written by hand; and damaged files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vericone/geometry/error.h>
#include <vericone/scenes/scene.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/random.h"

namespace vericone::robot_test {
namespace {

using Eigen::Vector3d;
using scenes::SceneBody, scenes::scene_of_text;
using ::testing::HasSubstr;

/// A folder of its own, gone at the end.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() / ("vericone_robot_" + std::to_string(::getpid()))) {
    std::filesystem::create_directory(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  SceneBody body(const std::string& fields) const {
    return scene_of_text("agent: {center: [0, 0, 99], semi_axes: [1, 1, 1]}\nobstacle: " + fields,
                         path_ / "none.yaml")
        .obstacle;
  }
  /// What it is refused as.
  std::string refusal(const std::string& fields) const {
    try {
      (void)body(fields);
    } catch (const InputError& e) {
      return e.what();
    }
    return "nothing";
  }

 private:
  std::filesystem::path path_;
};

// Two bars of 2 and 1 m that turn about z, a hand that slides up, and a finger that turns as the first bar.
const char* const kUrdf = R"(<?xml version="1.0"?>
<robot name="arm"> <!-- of a test -->
  <link name="base"><collision><origin xyz="0 0 0.25"/><geometry><box size="1 1 0.5"/></geometry></collision></link>
  <link name="bar"><collision><origin xyz="1 0 0" rpy="0 1.5707963267948966 0"/>
    <geometry><cylinder radius="0.1" length="2"/></geometry></collision></link>
  <link name="fore"><visual><geometry><mesh filename="package://arm/fore.dae"/></geometry></visual>
    <collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.2 0.2"/></geometry></collision></link>
  <link name="hand"><collision><geometry><sphere radius="0.25"/></geometry></collision></link>
  <link name="finger"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="bar"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="bar"/><child link="fore"/><origin xyz="2 0 0"/>
    <axis xyz="0 0 3"/></joint>
  <joint name="lift" type="prismatic"><parent link="fore"/><child link="hand"/><origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="0.5" effort="1" velocity="1"/></joint>
  <joint name="copy" type="revolute"><parent link="hand"/><child link="finger"/><axis xyz="0 0 1"/>
    <limit lower="-9" upper="9"/><mimic joint="shoulder" multiplier="-2" offset="0.5"/></joint>
</robot>)";

const char* const kSdf = R"(<sdf version="1.9"><model name="arm">
  <frame name="middle"><pose>0 0 0.25 0 0 0</pose></frame>
  <link name="base"><collision name="c"><pose relative_to="middle"/><geometry><box><size>1 1 0.5</size></box></geometry>
    </collision></link>
  <link name="bar"><pose relative_to="shoulder"/><collision name="c"><pose degrees="true">1 0 0 0 90 0</pose>
    <geometry><cylinder><radius>0.1</radius><length>2</length></cylinder></geometry></collision></link>
  <link name="fore"><pose>2 0 0.5 0 0 0</pose><collision name="c"><pose>0.5 0 0 0 0 0</pose>
    <geometry><box><size>1 0.2 0.2</size></box></geometry></collision></link>
  <link name="hand"><pose relative_to="fore">1 0 0 0 0 0</pose>
    <collision name="c"><geometry><sphere><radius>0.25</radius></sphere></geometry></collision></link>
  <joint name="shoulder" type="revolute"><pose relative_to="base">0 0 0.5 0 0 0</pose><parent>base</parent>
    <child>bar</child><axis><xyz>0 0 1</xyz><limit><lower>-2</lower><upper>2</upper></limit></axis></joint>
  <joint name="elbow" type="revolute"><pose>0 0 0 0 0 0.7</pose><parent>bar</parent><child>fore</child>
    <axis><xyz expressed_in="__model__">0 0 1</xyz></axis></joint>
  <joint name="lift" type="prismatic"><parent>fore</parent><child>hand</child><axis><limit><lower>0</lower>
    <upper>0.5</upper></limit></axis></joint>
</model></sdf>)";

std::string joints(double shoulder, double elbow, double lift) {
  std::ostringstream text;
  text.precision(17);
  text << "joints: {shoulder: " << shoulder << ", elbow: " << elbow << ", lift: " << lift << "}}";
  return text.str();
}

TEST(Robot, OfUrdfAndSdfStandsWhereItsJointsSay) {
  Folder folder;
  folder.write("arm.urdf", kUrdf);
  folder.write("arm.sdf", kSdf);
  testing::Random random(5);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < testing::share(200); ++i) {
    const double a = random.uniform(-2, 2), b = random.uniform(-9, 9), up = random.uniform(0, 0.5);
    const SceneBody urdf = folder.body("{robot: arm.urdf, " + joints(a, b, up)),
                    sdf = folder.body("{robot: arm.sdf, " + joints(a, b, up));
    const Assembly &x = *urdf.pieces(), &y = *sdf.pieces();
    ASSERT_EQ(x.size(), 4u);
    ASSERT_EQ(y.size(), 4u);
    // The closed form of a planar arm.
    const Vector3d along(std::cos(a), std::sin(a), 0), fore(std::cos(a + b), std::sin(a + b), 0);
    const Vector3d elbow = 2 * along + Vector3d(0, 0, 0.5), hand = elbow + fore + Vector3d(0, 0, up);
    for (const Assembly* one : {&x, &y}) {
      EXPECT_LT((one->convex_piece(1).middle() - (along + Vector3d(0, 0, 0.5))).norm(), 1e-12);
      EXPECT_LT((one->convex_piece(2).middle() - (elbow + 0.5 * fore)).norm(), 1e-12);
      EXPECT_LT((one->convex_piece(3).middle() - hand).norm(), 1e-12);
      EXPECT_EQ(one->convex_piece(3).margin(), 0.25);
    }
    for (int k = 0; k < 20; ++k) {
      const Vector3d n = random.vector<3>().normalized();
      for (std::size_t piece = 0; piece < 4; ++piece)
        EXPECT_NEAR(x.convex_piece(piece).support(n), y.convex_piece(piece).support(n), 1e-12);
    }
  }
}

TEST(Robot, OfSdfAtRestIsTheBodyWrittenByHand) {
  Folder folder;
  folder.write("world.sdf",
               R"(<sdf version="1.8"><world name="w"><model name="a"><pose>4 0 0 0 0 0</pose><link name="l">
    <collision name="1"><geometry><capsule><radius>0.5</radius><length>2</length></capsule></geometry></collision>
    <collision name="2"><pose>0 3 0 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry></collision>
    </link></model><model name="b"><link name="l"><pose>0 0 7 0 0 0</pose>
    <collision name="3"><geometry><ellipsoid><radii>1 2 3</radii></ellipsoid></geometry></collision></link></model>
    </world></sdf>)");
  const SceneBody read = folder.body("{robot: world.sdf, margin: 0.125}");
  const SceneBody hand = folder.body(
      "{pieces: [{capsule: {radius: 0.5, length: 2}, center: [4, 0, 0]}, {box: {half_widths: [0.5, 1, 1.5]},"
      " center: [4, 3, 0]}, {center: [0, 0, 7], semi_axes: [1, 2, 3]}], margin: 0.125}");
  ASSERT_EQ(read.pieces()->size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.pieces()->convex_piece(i).pieces(), hand.pieces()->convex_piece(i).pieces()) << i;
    EXPECT_EQ(read.pieces()->convex_piece(i).margin(), hand.pieces()->convex_piece(i).margin()) << i;
  }
  EXPECT_EQ(folder.body("{robot: world.sdf, links: ['b::l']}").pieces()->size(), 1u);
}

TEST(Robot, HasItsMeshesScaledAndMirrored) {
  Folder folder;
  folder.write("shapes/tooth.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  const auto robot = [](const std::string& mesh) {
    return "<robot name='r'><link name='l'><collision><geometry><mesh filename='" + mesh +
           "' scale='2 -3 0.5'/></geometry></collision></link></robot>";
  };
  folder.write("in/package.urdf", robot("package://teeth/tooth.obj"));
  folder.write("in/beside.urdf", robot("../shapes/tooth.obj"));
  folder.write("in/out.urdf", robot("package://teeth/../../etc/passwd"));
  for (const char* fields :
       {"{robot: in/package.urdf, packages: {teeth: shapes}}", "{robot: in/beside.urdf}"}) {
    const SceneBody body = folder.body(fields);
    const Assembly& mesh = *body.pieces();
    ASSERT_EQ(mesh.kind(), PieceKind::triangle);
    EXPECT_EQ(mesh.piece(0).points(), (std::vector<Vector3d>{{0, 0, 0.5}, {0, -3, 0}, {2, 0, 0}}));
  }
  EXPECT_THAT(folder.refusal("{robot: in/package.urdf}"), HasSubstr("{teeth: FOLDER}"));
  EXPECT_THAT(folder.refusal("{robot: in/out.urdf, packages: {teeth: shapes}}"),
              HasSubstr("within its package"));
}

TEST(Robot, HasMeshesOfScenesUpright) {
  Folder folder;
  // The same triangle: z up in metres, y up in centimetres.
  const auto dae = [](const char* asset, const char* points) {
    return std::string("<COLLADA version='1.4.1'><asset>") + asset +
           "</asset><library_geometries><geometry><mesh><source id='s'><float_array id='f'>" + points +
           "</float_array><technique_common><accessor source='#f' count='3' "
           "stride='3'/></technique_common></source>"
           "<vertices id='v'><input semantic='POSITION' source='#s'/></vertices><triangles><input "
           "semantic='VERTEX' "
           "source='#v' offset='0'/><p>0 1 "
           "2</p></triangles></mesh></geometry></library_geometries></COLLADA>";
  };
  folder.write("metres.dae", dae("<up_axis>Z_UP</up_axis>", "1 0 0 0 1 0 0 0 2"));
  folder.write("centimetres.dae", dae("<unit meter='0.01'/>", "100 0 0 0 0 -100 0 200 0"));
  folder.write("up.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 9, "uri":
      "data:;base64,AQAAAAD/AAIA"}], "bufferViews": [{"buffer": 0, "byteLength": 9}], "accessors": [{"bufferView": 0,
      "componentType": 5120, "type": "VEC3", "count": 3}], "meshes": [{"primitives": [{"attributes": {"POSITION":
      0}}]}]})");
  for (const char* name : {"metres.dae", "centimetres.dae", "up.gltf"}) {
    folder.write("r.urdf",
                 std::string("<robot name='r'><link name='l'><collision><geometry><mesh filename='") + name +
                     "'/></geometry></collision></link></robot>");
    for (const std::string& fields : {std::string("{robot: r.urdf}"), std::string("{mesh: ") + name + "}"}) {
      const SceneBody body = folder.body(fields);
      EXPECT_EQ(body.pieces()->piece(0).points(), (std::vector<Vector3d>{{1, 0, 0}, {0, 1, 0}, {0, 0, 2}}))
          << fields;
    }
  }
}

TEST(Robot, OfSdfIncludesFilesBesideIt) {
  Folder folder;
  folder.write("models/box/model.sdf",
               "<sdf version='1.9'><model name='box'><pose>1 0 0 0 0 0</pose><link name='l'><collision "
               "name='c'><geometry><mesh>"
               "<uri>box.obj</uri></mesh></geometry></collision></link></model></sdf>");
  folder.write("models/box/box.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  folder.write("world.sdf",
               "<sdf version='1.9'><world "
               "name='w'><include><uri>model://box</uri></include><include><uri>models/box</uri>"
               "<name>other</name><pose>0 0 7 0 0 0</pose></include></world></sdf>");
  const SceneBody body = folder.body("{robot: world.sdf, packages: {box: models/box}}");
  ASSERT_EQ(body.pieces()->size(), 2u);
  EXPECT_EQ(body.pieces()->piece(0).points(), (std::vector<Vector3d>{{2, 0, 0}, {1, 1, 0}, {1, 0, 1}}));
  EXPECT_EQ(body.pieces()->piece(1).points(), (std::vector<Vector3d>{{1, 0, 7}, {0, 1, 7}, {0, 0, 8}}));
  EXPECT_EQ(
      folder.body("{robot: world.sdf, packages: {box: models/box}, links: ['other::l']}").pieces()->size(),
      1u);
  folder.write("models/box/model.sdf", "<sdf version='1.9'>\n<model name='box'><link/></model></sdf>");
  EXPECT_THAT(folder.refusal("{robot: world.sdf, packages: {box: models/box}}"),
              HasSubstr("line 1: model://box, line 2: <link>"));
}

/// A link a quarter turn about z from the model, whose joint turns it about x by another: a ball 4 m above it
/// goes to -y where x is the model's, to x where it is that of the link, and so of the joint.
TEST(Robot, OfSdfTurnsAboutAxesAsItsVersionSays) {
  Folder folder;
  const auto ball = [&](const std::string& version, const std::string& frame, const std::string& turned) {
    folder.write("arm.sdf", "<sdf version='" + version + R"('><model name='m'><link name='base'/>
    <link name='arm'><pose degrees=')" +
                                turned + R"('>0 0 0 0 0 90</pose><collision name='c'><pose>0 0 4 0 0 0</pose>
    <geometry><sphere><radius>0.5</radius></sphere></geometry></collision></link><joint name='j' type='revolute'>
    <parent>base</parent><child>arm</child><axis><xyz>1 0 0</xyz>)" +
                                frame + "</axis></joint></model></sdf>");
    return folder.body("{robot: arm.sdf, joints: {j: 1.5707963267948966}}").placed.body.bounds();
  };
  const auto expect_at = [&](const Vector3d& at, const Box& box) {
    EXPECT_LT((0.5 * (box.low + box.high) - at).norm(), 1e-12) << box.low.transpose();
  };
  const auto asked = [](const std::string& word) {
    return "<use_parent_model_frame>" + word + "</use_parent_model_frame>";
  };
  for (const char* version : {"1.0", "1.2", "1.4"}) expect_at({0, -4, 0}, ball(version, "", "true"));
  for (const char* version : {"1.5", "1.6", "1.9", "1.10", "1.12"})
    expect_at({4, 0, 0}, ball(version, "", "1"));
  for (const char* word : {"true", "True", "TRUE", "1", " 1 "})
    expect_at({0, -4, 0}, ball("1.6", asked(word), "True"));
  for (const char* word : {"false", "False", "0"}) expect_at({4, 0, 0}, ball("1.6", asked(word), "TRUE"));
  EXPECT_THROW(ball("1.6", asked("yes"), "true"), InputError);
}

/// The finger turns by -2 (the shoulder's angle - 0.25) + 0.5, as its joint says.
TEST(Robot, OfSdfHasJointsThatFollowOthers) {
  Folder folder;
  std::string text = kSdf;
  text.insert(
      text.find("</model>"),
      "<link name='finger'><pose relative_to='hand'/><collision name='c'><pose>1 0 0 0 0 0</pose><geometry>"
      "<sphere><radius>0.25</radius></sphere></geometry></collision></link><joint name='copy' "
      "type='revolute'><parent>hand</parent><child>finger</child><axis><xyz>0 0 1</xyz><mimic "
      "joint='shoulder'><multiplier>-2</multiplier><offset>0.5</offset><reference>0.25</reference></mimic>"
      "</axis></joint>");
  folder.write("arm.sdf", text);
  const double a = 0.7, b = -0.3, turned = a + b - 2 * (a - 0.25) + 0.5;
  const SceneBody body = folder.body("{robot: arm.sdf, " + joints(a, b, 0.125));
  const Vector3d hand(2 * std::cos(a) + std::cos(a + b), 2 * std::sin(a) + std::sin(a + b), 0.625);
  EXPECT_LT((body.pieces()->convex_piece(4).middle() - hand - Vector3d(std::cos(turned), std::sin(turned), 0))
                .norm(),
            1e-12);
}

TEST(Robot, ThatIsNoneIsRefusedInOneLine) {
  Folder folder;
  folder.write("arm.urdf", kUrdf);
  const auto urdf = [](const std::string& inner) { return "<robot name='r'>\n" + inner + "\n</robot>"; };
  const std::string two = "<link name='a'/><link name='b'/>",
                    ab = "<parent link='a'/><child link='b'/></joint>";
  const std::pair<std::string, const char*> files[] = {
      {"", "an element"},
      {"<robot", "the end of the element robot"},
      {"<robot></link>", "</robot>, of line 1"},
      {"<!DOCTYPE a [<!ENTITY b 'c'>]><robot/>", "document types"},
      {urdf("&b;"), "&lt;"},
      {urdf("<link name='a' name='b'/>"), "given once"},
      {urdf("<xacro:macro/>"), "xacro FILE"},
      {"<world/>", "<robot> (URDF) or <sdf>"},
      {urdf(""), "one link or more"},
      {urdf(two), "one: the others are joined to it"},
      {urdf("<link name='a'/><link name='a'/>"), "no other link has"},
      {urdf(two + "<joint name='j' type='floating'>" + ab), "fixed, revolute"},
      {urdf(two + "<joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>"),
       "the name of a link"},
      {urdf(two + "<joint name='j' type='fixed'>" + ab + "<joint name='k' type='fixed'>" + ab),
       "the child of one joint"},
      {urdf(two + "<joint name='j' type='fixed'>" + ab +
            "<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint>"),
       "in a circle"},
      {urdf(two + "<joint name='j' type='revolute'><mimic joint='j'/>" + ab), "in a circle"},
      {urdf(two + "<joint name='j' type='revolute'><axis xyz='0 0 0'/>" + ab), "a direction"},
      {urdf("<link name='a'><collision><geometry><box size='1 2'/></geometry></collision></link>"),
       "3 finite numbers"},
      {urdf("<link name='a'><collision><geometry><sphere radius='-1'/></geometry></collision></link>"),
       "0 or more"},
      {urdf("<link name='a'><collision><geometry><sphere radius='nan'/></geometry></collision></link>"),
       "1 finite number"},
      {urdf("<link name='a'><collision><geometry><torus/></geometry></collision></link>"), "cylinder"},
      {"<sdf><model name='m'/></sdf>", "version"},
      {"<sdf version='2.0'><model name='m'/></sdf>", "or a later 1.x"},
      {"<sdf version='1.x'><model name='m'/></sdf>", "or a later 1.x"},
      {"<sdf version='1.6'><model name='m'><link name='l'><pose frame='k'>5 0 0 0 0 "
       "0</pose></link></model></sdf>",
       "relative_to"},
      {"<sdf version='1.9'><model name='m'><link name='l'><pose degrees='yes'>0 0 0 0 0 "
       "9</pose></link></model></sdf>",
       "true or false"},
      {"<sdf version='1.9'><model name='m'><include/></model></sdf>", "no model in another"},
      {"<sdf version='1.9'><model name='m'><frame name='a' attached_to='b'/><frame name='b' "
       "attached_to='a'/><link "
       "name='l'>"
       "<pose relative_to='a'/></link></model></sdf>",
       "in a circle"},
      {"<sdf version='1.9'><model name='m'><link name='l'><collision><geometry><plane><normal>0 0 "
       "0</normal></plane></geometry></collision></link></model></sdf>",
       "a direction"},
      {"<sdf version='1.9'><include><uri>none</uri></include></sdf>", "no such file"},
      {"<sdf version='1.9'><include><uri>https://models/robot</uri></include></sdf>", "a file's name"},
      {"<sdf version='1.9'><include><uri>x.urdf</uri></include></sdf>", "in the included file itself"},
      {"<sdf version='1.9'><include><uri>arm.urdf</uri></include></sdf>", "<sdf>"},
      {"<sdf version='1.9'><model name='m'><pose relative_to='k'/><link name='l'/></model></sdf>",
       "stand in the world"}};
  for (const auto& [text, expected] : files) {
    folder.write("x.urdf", text);
    const std::string refusal = folder.refusal("{robot: x.urdf}");
    EXPECT_THAT(refusal, ::testing::StartsWith("obstacle.robot: got x.urdf, line ")) << text;
    EXPECT_THAT(refusal, HasSubstr(expected)) << text;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  }
  EXPECT_THAT(folder.refusal("{robot: arm.urdf, joints: {shoulder: 3}}"), HasSubstr("between -2 and 2"));
  EXPECT_THAT(folder.refusal("{robot: arm.urdf, joints: {copy: 1}}"), HasSubstr("shoulder, elbow, lift"));
  EXPECT_THAT(folder.refusal("{robot: arm.urdf, joints: {wrist: 1}}"), HasSubstr("shoulder, elbow, lift"));
  EXPECT_THAT(folder.refusal("{robot: arm.urdf, links: [foot]}"), HasSubstr("obstacle.links"));
  EXPECT_THAT(folder.refusal("{robot: none.urdf}"), HasSubstr("no such file"));
  // The ground of a world, in a frame that leans: what is behind its plane.
  folder.write("ground.sdf",
               "<sdf version='1.9'><model name='m'><link name='l'><pose>0 0 1 0 0 0</pose><collision "
               "name='c'><geometry><plane>"
               "<normal>0 3 4</normal></plane></geometry></collision></link></model></sdf>");
  EXPECT_THAT(folder.refusal("{robot: ground.sdf}"), HasSubstr("obstacle.extent"));
  const SceneBody ground = folder.body("{robot: ground.sdf, extent: 50}");
  EXPECT_NEAR(ground.placed.support({0, 0.6, 0.8}), 0.8, 1e-12);
  EXPECT_NEAR(ground.placed.support({0, -0.6, -0.8}), 50 - 0.8, 1e-9);
  EXPECT_NEAR(ground.placed.support({1, 0, 0}), 50, 1e-9);
  folder.write("deep.urdf", std::string(100'000, '<'));
  EXPECT_THAT(folder.refusal("{robot: deep.urdf}"), HasSubstr("deep.urdf"));
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  folder.write("deep.urdf", deep);
  EXPECT_THAT(folder.refusal("{robot: deep.urdf}"), HasSubstr("at most 50"));
}

TEST(Robot, ThatIsDamagedIsReadOrRefusedInOneLine) {
  Folder folder;
  testing::Random random(6);
  SCOPED_TRACE(random.trace());
  int refused = 0;
  for (int i = 0; i < testing::share(1200); ++i) {
    std::string text = i % 2 ? kUrdf : kSdf;
    if (i % 3 == 0) text.resize(std::size_t(random.integer(0, int(text.size()) - 1)));
    for (int k = random.integer(0, 4); k > 0 && !text.empty(); --k)
      text[std::size_t(random.integer(0, int(text.size()) - 1))] = char(random.integer(0, 255));
    folder.write("x", text);
    const std::string refusal = folder.refusal("{robot: x}");
    refused += refusal != "nothing";
    ASSERT_EQ(refusal.find('\n'), std::string::npos) << text;
  }
  EXPECT_GT(refused, testing::share(400));
}

}  // namespace
}  // namespace vericone::robot_test
