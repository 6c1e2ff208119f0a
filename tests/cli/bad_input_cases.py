# SPDX-License-Identifier: BSD-3-Clause
"""Bad inputs and the one line that each gets. docs/reference/bad-input.md has one of each kind, printed by
`/usr/bin/python3 tests/cli/bad_input_cases.py VERICONE > docs/reference/bad-input.md`; the test runs every case and compares
the page as well, so neither can go stale."""
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "certify"))
import certify_cases  # noqa: E402

GOOD_AGENT = {"center": [0, 0, 0], "semi_axes": [1, 2, 3], "rotation": [1, 0, 0, 0]}
GOOD_OBSTACLE = {"center": [10, 0, 0], "shape": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}


def case(agent=None, obstacle=None, **other):
    """An engagement with changes; a value of None leaves a field out."""
    def changed(body, changes):
        body = {**body, **(changes or {})}
        return {k: v for k, v in body.items() if v is not ...}
    result = {"id": 7, "agent": changed(GOOD_AGENT, agent), "obstacle": changed(GOOD_OBSTACLE, obstacle),
              "agent_velocity": [1, 0, 0], "obstacle_velocity": [0, 0, 0], **other}
    return {k: v for k, v in result.items() if v is not ...}


def dented(*hyperboloids, **obstacle):
    """An engagement whose obstacle is an ellipsoid with semi-axes 1, 2, 3 and these hyperboloids."""
    return case(obstacle={"shape": ..., "semi_axes": [1, 2, 3], "hyperboloids": list(hyperboloids), **obstacle})


GOOD_HYPERBOLOID = {"sheets": 2, "semi_axes": [0.5, 1, 1]}


def planar(agent_velocity=(1, 0), **obstacle):
    """An engagement in the plane."""
    body = {"center": [9, 0], **obstacle}
    return {"id": 7, "agent": {"center": [0, 0], "semi_axes": [1, 2]},
            "obstacle": {k: v for k, v in body.items() if v is not ...},
            "agent_velocity": list(agent_velocity), "obstacle_velocity": [0, 0]}


TRACK = "t,x,y\n0,1,2\n"
# Files in the folder that the commands run in.
FILES = {"junk.obj": "v 1 2\n", "points.xyz": "0 0 0\n1 0 0\n", "cut.bt": "# Octomap OcTree binary file\nid OcTree\n"}
FILES["arm.urdf"] = ("<robot name='arm'><link name='base'/><link name='bar'><collision><geometry><sphere radius='1'/>"
                     "</geometry></collision></link><joint name='shoulder' type='revolute'><parent link='base'/>"
                     "<child link='bar'/><limit lower='-1' upper='2'/></joint></robot>\n")
FILES["cut.urdf"] = FILES["arm.urdf"][:90]
CUBE = {"points": [[x, y, z] for x in (9, 11) for y in (-1, 1) for z in (-1, 1)]}


def pieces(agent=None, **obstacle):
    """An engagement with a body of pieces."""
    return {"id": 7, "agent": agent or {"center": [0, 0, 0], "semi_axes": [1, 2, 3]}, "obstacle": obstacle,
            "agent_velocity": [1, 0, 0], "obstacle_velocity": [0, 0, 0]}


def flat(agent=None, velocity=(1, 0), **obstacle):
    """An engagement in the plane, of a polygon if nothing else is said."""
    return {"id": 7, "agent": agent or {"stadium": {"radius": 1, "length": 2}, "center": [20, 0]},
            "obstacle": obstacle or {"polygon": SQUARE}, "agent_velocity": list(velocity), "obstacle_velocity": [0, 0]}


SQUARE = [[0, 0], [8, 0], [8, 8], [0, 8]]
AT_REST = {"position": [0, 0], "velocity": [20, 0]}
AHEAD = {"position": [50, -30], "velocity": [22, 0]}


def law(name="rendezvous", **changes):
    """A line of `vericone law` with changes; a value of ... leaves a field out."""
    fields = {"rendezvous": {"vehicle": AHEAD}, "focal": {"vehicles": [AHEAD]}, "pursuit": {"vehicles": [AHEAD]},
              "vertical": {"size": 127, "size_rate": 0, "altitude": 425, "climb": 0}}.get(name, {})
    agent = {} if name == "vertical" else {"agent": AT_REST}
    return {k: v for k, v in {"id": 7, "law": name, **agent, **fields, **changes}.items() if v is not ...}


# What is wrong, the line of the law.
LAWS = [
    ("an unknown law", law("chase")),
    ("no law", law(law=...)),
    ("no agent", law(agent=...)),
    ("an agent without velocity", law(agent={"position": [0, 0]})),
    ("an agent in space", law(agent={"position": [0, 0, 150], "velocity": [20, 0]})),
    ("a vehicle where the agent is", law(vehicle={"position": [0, 0], "velocity": [22, 0]})),
    ("a vehicle beyond all fields", law(vehicle={"position": [1e9, 0], "velocity": [22, 0]})),
    ("an unknown gain", law(gains={"K1": 1})),
    ("a negative gain", law(gains={"cone": -1})),
    ("no acceleration at all", law(gains={"most": 0})),
    ("no vehicles", law("focal", vehicles=[])),
    ("vehicles without size", law("pursuit", side=0)),
    ("foci and vehicles", law("focal", foci=[[100, -10], [100, 14]])),
    ("foci without velocities", law("focal", vehicles=..., foci=[[100, -10], [100, 14]], a=20)),
    ("an ellipse smaller than its foci are apart",
     law("focal", vehicles=..., foci=[[100, -10], [100, 14]], foci_velocities=[[5, 0], [5, 0]], a=10)),
    ("an unknown form", law("focal", form="best")),
    ("a negative size", law("vertical", size=-1)),
    ("a camera below the ground", law("vertical", altitude=-5)),
    ("no climb", law("vertical", climb=...)),
    ("a covariance that is none", law("pursuit", covariance=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]])),
    ("an unsymmetric covariance", law("pursuit", covariance=[[1, 1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])),
    ("deviations of nothing", law("pursuit", deviations=2)),
    ("a broken line of states", "{\"law\": "),
]

# What is wrong, the line of the query.
QUERIES = [
    ("a zero semi-axis", case(agent={"semi_axes": [1, 0, 3]})),
    ("a negative semi-axis", case(agent={"semi_axes": [1, 2, -3]})),
    ("two semi-axes", case(agent={"semi_axes": [1, 2]})),
    ("a spin that is a number, in space", case(agent={"spin": 1})),
    ("a spin of text", case(agent={"spin": [0, 0, "fast"]})),
    ("an acceleration in the plane, in space", case(obstacle={"acceleration": [1, 2]})),
    ("brakes that push", case(agent={"braking": -1})),
    ("brakes beside an acceleration", case(agent={"braking": 1, "acceleration": [0, 0, 1]})),
    ("a spin beside errors", case(agent={"spin": [0, 0, 1]}, position_error={"ball": 1})),
    ("bodies that turn beside each other without end", case(agent={"spin": [0, 0, 1]}, agent_velocity=[0, 0, 0])),
    ("a semi-axis that is text", case(agent={"semi_axes": [1, "2", 3]})),
    ("a semi-axis in knots", case(agent={"semi_axes": ["1 kn", 2, 3]})),
    ("a semi-axis in an unknown unit", case(agent={"semi_axes": ["1 furlong", 2, 3]})),
    ("a place on the Earth without origin", case(agent={"center": {"latitude": 52, "longitude": 4, "altitude": 0}})),
    ("a latitude beyond the pole", {**case(agent={"center": {"latitude": 91, "longitude": 4, "altitude": 0}}),
                                    "origin": {"latitude": 52, "longitude": 4}}),
    ("an origin that is a list", {**case(), "origin": [52, 4]}),
    ("a semi-axis that is null", case(agent={"semi_axes": [None, 2, 3]})),
    ("semi-axes that are no list", case(agent={"semi_axes": 2})),
    ("semi-axes whose squares overflow", case(agent={"semi_axes": [1, 2, 1e200]})),
    ("no centre", case(agent={"center": ...})),
    ("a centre in the plane", case(agent={"center": [1, 2]})),
    ("a centre with a truth value", case(obstacle={"center": [True, 0, 0]})),
    ("a quaternion of length 2", case(agent={"rotation": [2, 0, 0, 0]})),
    ("a zero quaternion", case(agent={"rotation": [0, 0, 0, 0]})),
    ("a rotation of five numbers", case(agent={"rotation": [1, 0, 0, 0, 0]})),
    ("a rotation matrix that shears", case(agent={"rotation": [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]})),
    ("a reflection", case(agent={"rotation": [[1, 0, 0], [0, 1, 0], [0, 0, -1]]})),
    ("a ragged rotation matrix", case(agent={"rotation": [[1, 0, 0], [0, 1], [0, 0, 1]]})),
    ("no shape", case(agent={"semi_axes": ..., "rotation": ...})),
    ("two shapes", case(obstacle={"semi_axes": [1, 1, 1]})),
    ("a shape with a rotation", case(obstacle={"rotation": [1, 0, 0, 0]})),
    ("an unsymmetric shape", case(obstacle={"shape": [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]})),
    ("an indefinite shape", case(obstacle={"shape": [[1, 2, 0], [2, 1, 0], [0, 0, 1]]})),
    ("a singular shape", case(obstacle={"shape": [[1, 1, 0], [1, 1, 0], [0, 0, 1]]})),
    ("a zero shape", case(obstacle={"shape": [[0, 0, 0], [0, 0, 0], [0, 0, 0]]})),
    ("a shape of two rows", case(obstacle={"shape": [[1, 0, 0], [0, 1, 0]]})),
    ("a quadric that is a hyperboloid", case(obstacle={"center": ..., "shape": ..., "quadric": [
        [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, -1]]})),
    ("a quadric without a real point", case(obstacle={"center": ..., "shape": ..., "quadric": [
        [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]})),
    ("a quadric with a centre", case(obstacle={"shape": ..., "quadric": [
        [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -1]]})),
    ("a misspelt field of a body", case(agent={"semi_axis": [1, 2, 3]})),
    ("a misspelt field of the engagement", case(agent_speed=3)),
    ("no agent", case(agent_velocity=[1, 0, 0], **{}) | {"agent": None}),
    ("no obstacle", {k: v for k, v in case().items() if k != "obstacle"}),
    ("an agent that is a list", case() | {"agent": [1, 2, 3]}),
    ("no velocity", case(agent_velocity=...)),
    ("a velocity of two numbers", case(obstacle_velocity=[1, 2])),
    ("a hyperboloid that misses the ellipsoid", dented({"sheets": 2, "semi_axes": [1.5, 1, 1]})),
    ("a second one that misses it", dented(GOOD_HYPERBOLOID, {"sheets": 1, "semi_axes": [1, 2.5, 3.5]})),
    ("a hyperboloid of three sheets", dented(GOOD_HYPERBOLOID, {"sheets": 3, "semi_axes": [1, 1, 1]})),
    ("sheets that are text", dented({"sheets": "two", "semi_axes": [0.5, 1, 1]})),
    ("a hyperboloid without sheets", dented({"semi_axes": [0.5, 1, 1]})),
    ("a hyperboloid with a negative semi-axis", dented({"sheets": 2, "semi_axes": [0.5, -1, 1]})),
    ("a hyperboloid with two semi-axes", dented({"sheets": 2, "semi_axes": [0.5, 1]})),
    ("a hyperboloid without semi-axes", dented({"sheets": 2})),
    ("a hyperboloid turned by a shear", dented(
        {**GOOD_HYPERBOLOID, "rotation": [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]})),
    ("a hyperboloid with a centre", dented({**GOOD_HYPERBOLOID, "center": [0, 0, 0]})),
    ("a hyperboloid that is a number", dented(2)),
    ("hyperboloids that are no list", dented(hyperboloids=GOOD_HYPERBOLOID)),
    ("hyperboloids with a shape matrix", case(obstacle={"hyperboloids": [GOOD_HYPERBOLOID]})),
    ("hyperbolas in space", dented(hyperboloids=..., hyperbolas=[])),
    ("k above 1", planar(a_c=3, b_c=2, k=1.5, phi=0)),
    ("a negative k", planar(a_c=3, b_c=2, k=-0.1)),
    ("a conic without k", planar(a_c=3, b_c=2)),
    ("a conic with a negative b_c", planar(a_c=3, b_c=-2, k=0.5)),
    ("a conic with a phi that is a list", planar(a_c=3, b_c=2, k=0.5, phi=[0])),
    ("a hyperbola that misses the ellipse", planar(semi_axes=[3, 2], hyperbolas=[{"semi_axes": [4, 1]}])),
    ("a hyperbola with three semi-axes", planar(semi_axes=[3, 2], hyperbolas=[{"semi_axes": [1, 1, 1]}])),
    ("hyperbolas with a shape matrix", planar(shape=[[4, 0], [0, 1]], hyperbolas=[{"semi_axes": [1, 1]}])),
    ("a planar body with a quaternion", planar(semi_axes=[3, 2], rotation=[1, 0, 0, 0])),
    ("a planar body with two shapes", planar(semi_axes=[3, 2], a_c=3, b_c=2, k=0)),
    ("a planar body with hyperboloids", planar(semi_axes=[3, 2], hyperboloids=[])),
    ("a planar body and a velocity in space", planar(agent_velocity=(1, 0, 0), semi_axes=[3, 2])),
    ("a mesh that is not there", pieces(mesh="nowhere.obj")),
    ("a mesh that is not one", pieces(mesh="junk.obj")),
    ("a mesh without faces", pieces(mesh="points.xyz")),
    ("a mesh that is a number", pieces(mesh=3)),
    ("a mesh with a radius", pieces(mesh="points.xyz", radius=1)),
    ("a folder for a mesh", pieces(mesh=".")),
    ("a cloud without a radius", pieces(cloud="points.xyz")),
    ("a cloud with a negative radius", pieces(cloud="points.xyz", radius=-0.1)),
    ("a cloud with a radius that is text", pieces(cloud="points.xyz", radius="1 kg")),
    ("a scale of zero", pieces(cloud="points.xyz", radius=1, scale=0)),
    ("a scale that is a list", pieces(cloud="points.xyz", radius=1, scale=[1, 1, 2])),
    ("a scale that overflows", pieces(cloud="points.xyz", radius=1, scale=1e308, center=[0, 0, 0])
     | {"obstacle": {**CUBE, "scale": 1e308}}),
    ("a map that is not there", pieces(octree="nowhere.bt")),
    ("a map that breaks off", pieces(octree="cut.bt")),
    ("a map whose unknown space is uncertain", pieces(octree="cut.bt", unknown="maybe")),
    ("a map whose free space is a truth value", pieces(octree="cut.bt", free=True)),
    ("a threshold above 1", pieces(octree="cut.bt", occupied_above=1.5)),
    ("a region of one corner", pieces(octree="cut.bt", region=[[0, 0, 0]])),
    ("a region turned over", pieces(octree="cut.bt", region=[[1, 1, 1], [0, 2, 2]])),
    ("a region for a mesh", pieces(mesh="points.xyz", region=[[0, 0, 0], [1, 1, 1]])),
    ("no points", pieces(points=[])),
    ("points in the plane", pieces(points=[[1, 2]])),
    ("a polygon of two corners", flat(polygon=[[0, 0], [1, 0]])),
    ("a polygon that crosses itself", flat(polygon=[[0, 0], [4, 4], [4, 0], [0, 4]])),
    ("a polygon in space", flat(polygon=[[0, 0, 0], [4, 4, 0], [4, 0, 0]])),
    ("a polygon that turns back", flat(polygon=[[0, 0], [4, 0], [2, 0]])),
    ("a hole beyond its polygon", flat(polygon=SQUARE, holes=[[[9, 9], [10, 9], [9, 10]]])),
    ("a hole that touches its polygon", flat(polygon=SQUARE, holes=[[[1, 0], [2, 1], [1, 2]]])),
    ("holes without a polygon", flat(stadium={"radius": 1, "length": 2}, holes=[[[1, 1], [2, 1], [1, 2]]])),
    ("a polygon and a stadium", flat(polygon=SQUARE, stadium={"radius": 1, "length": 2})),
    ("a stadium without radius", flat(stadium={"radius": 0, "length": 2})),
    ("a margin of a body with hyperbolas in the plane", flat(
        center=[0, 0], semi_axes=[2, 2], hyperbolas=[{"semi_axes": [1, 1]}], margin=0.1)),
    ("a polygon before a cylinder", pieces({"polygon": SQUARE}, cylinder={"radius": 1, "height": 2})),
    ("a half-space without a normal", pieces(half_space={"offset": 1})),
    ("a half-space with a normal of zero", pieces(half_space={"normal": [0, 0, 0], "offset": 1})),
    ("a half-space without an offset", pieces(half_space={"normal": [0, 0, 1]})),
    ("a half-space with a centre", pieces(half_space={"normal": [0, 0, 1], "offset": 1}, center=[1, 2, 3])),
    ("a half-space without extent in a union", pieces(pieces=[{"half_space": {"normal": [0, 0, 1], "offset": 1}}])),
    ("a half-space of the plane in space", pieces(half_space={"normal": [0, 1], "offset": 1, "extent": 5})),
    ("an extent of 0", pieces(half_space={"normal": [0, 0, 1], "offset": 1, "extent": 0})),
    ("a slab turned over", pieces(slab={"normal": [0, 0, 1], "offsets": [2, 1]})),
    ("an agent that is a half-space", pieces({"half_space": {"normal": [0, 0, 1], "offset": 1}}, **CUBE)),
    ("a slab from later on", {**pieces(slab={"normal": [0, 0, 1], "offsets": [5, 6]}), "horizon": [1, 2]}),
    ("a spin beside a half-space", pieces({"center": [0, 0, 0], "semi_axes": [1, 2, 3], "spin": [0, 0, 1]},
                                          half_space={"normal": [0, 0, 1], "offset": -9})),
    ("points and a mesh", pieces(points=[[1, 2, 3]], mesh="points.xyz")),
    ("a mesh and semi-axes", pieces(mesh="points.xyz", semi_axes=[1, 1, 1])),
    ("a cube with a centre in the plane", pieces(**CUBE, center=[1, 2])),
    ("a cube turned by a shear", pieces(**CUBE, rotation=[[1, 0.1, 0], [0, 1, 0], [0, 0, 1]])),
    ("an agent that is a mesh", pieces({"mesh": "points.xyz"}, **CUBE)),
    ("a planar agent before pieces", pieces({"center": [0, 0], "semi_axes": [1, 2]}, **CUBE)),
    ("a cylinder without a height", pieces(cylinder={"radius": 1})),
    ("a cylinder without a radius", pieces(cylinder={"height": 1})),
    ("a cylinder of a radius and semi-axes", pieces(cylinder={"radius": 1, "semi_axes": [1, 2], "height": 1})),
    ("a cylinder with a length", pieces(cylinder={"radius": 1, "length": 1})),
    ("a cylinder that is a list", pieces(cylinder=[1, 2])),
    ("a cylinder of negative radius", pieces(cylinder={"radius": -1, "height": 2})),
    ("a disc of text", pieces(disc={"radius": "wide"})),
    ("a disc with one semi-axis", pieces(disc={"semi_axes": [1]})),
    ("a capsule with a height", pieces(capsule={"radius": 1, "height": 2})),
    ("a cone of negative height", pieces(cone={"radius": 1, "height": -2})),
    ("a frustum of one radius", pieces(frustum={"radius": 1, "height": 2})),
    ("a frustum of three radii", pieces(frustum={"radii": [1, 2, 3], "height": 2})),
    ("a box of whole sizes", pieces(box={"size": [1, 2, 3]})),
    ("a box with a negative side", pieces(box={"half_widths": [1, -2, 3]})),
    ("a cylinder and a box", pieces(cylinder={"radius": 1, "height": 2}, box={"half_widths": [1, 2, 3]})),
    ("a cylinder in the plane", pieces(cylinder={"radius": 1, "height": 2}, center=[9, 0])),
    ("a negative margin", case(obstacle={"margin": -1})),
    ("a margin that is text", case(obstacle={"margin": "thick"})),
    ("a margin of a body with dents", dented(GOOD_HYPERBOLOID, margin=1)),
    ("a robot that is not there", pieces(robot="nowhere.urdf")),
    ("a robot that is a mesh", pieces(robot="junk.obj")),
    ("a robot that breaks off", pieces(robot="cut.urdf")),
    ("a joint that a robot has not", pieces(robot="arm.urdf", joints={"elbow": 1})),
    ("a joint beyond its limits", pieces(robot="arm.urdf", joints={"shoulder": 3})),
    ("joints in a list", pieces(robot="arm.urdf", joints=[1])),
    ("a link that a robot has not", pieces(robot="arm.urdf", links=["foot"])),
    ("a robot without pictures", pieces(robot="arm.urdf", geometry="visual")),
    ("a union of a mesh", pieces(pieces=[{"mesh": "points.xyz"}])),
    ("a union of a cylinder and a body with dents", pieces(pieces=[{"cylinder": {"radius": 1, "height": 2}}, {
        "center": [9, 0, 0], "semi_axes": [1, 2, 3], "hyperboloids": [GOOD_HYPERBOLOID]}])),
    ("a line that is a list", [1, 2, 3]),
    ("a line that is a number", 7),
    ("a broken line", '{"id": 7, "agent": {'),
    ("not a number", '{"id": 7, "agent": {"center": [NaN, 0, 0]}}'),
    ("a number out of range", '{"id": 7, "agent": {"center": [1e999, 0, 0]}}'),
    ("a field given twice", '{"id": 7, "agent": 1, "agent": 2}'),
    ("a line nested too deeply", "[" * 21 + "]" * 21),
    ("an error of negative radius", case(position_error={"ball": -1})),
    ("an error that is a number", case(velocity_error=0.5)),
    ("an error of two kinds", case(position_error={"ball": 1, "box": [1, 1, 1]})),
    ("an error of no kind", case(velocity_error={})),
    ("a flat ellipsoid of errors", case(velocity_error={"semi_axes": [1, 0, 1]})),
    ("a box of errors with two sides", case(position_error={"box": [1, 1]})),
    ("a box of errors with a negative side", case(position_error={"box": [1, 1, -1]})),
    ("a ball of errors with a rotation", case(position_error={"ball": 1, "rotation": [1, 0, 0, 0]})),
    ("a horizon of zero", case(position_error={"ball": 1}, horizon=0)),
    ("a horizon that is text", case(position_error={"ball": 1}, horizon="for ever")),
    ("a horizon that ends before it begins", case(horizon=[3, 2])),
    ("a later horizon beside an error", case(position_error={"ball": 1}, horizon=[1, 2])),
    ("errors in the plane", {**planar(semi_axes=[3, 2]), "position_error": {"ball": 1}}),
]

SCENE = "agent: {center: [0, 0, 0], semi_axes: [1, 2, 3]}\nobstacle: {center: [10, 0, 0], semi_axes: [1, 1, 1]}\n"
DENTED_SCENE = SCENE.replace("[1, 1, 1]}", "[1, 1, 1], hyperboloids: [{sheets: 2, semi_axes: [0.5, 1, 1]}]}")
PLANAR_SCENE = "agent: {center: [0, 0], semi_axes: [1, 2]}\nobstacle: {center: [9, 0], semi_axes: [1, 1]}\n"
PIECES_SCENE = ("agent: {center: [0, 0, 0], semi_axes: [1, 2, 3]}\n"
                "obstacle: {points: [[9, 0, 0], [9, 1, 0], [9, 0, 1], [10, 0, 0]]}\n")
LIDARS = "lidars: [{beams: {rows: 9, columns: 9, horizontal: 1, vertical: 1}}]\n"
# What is wrong, arguments (FILE stands for the scene), scene.
COMMANDS = [
    ("an unknown command", ["cones"], None),
    ("an unknown option", ["cone", "FILE", "--plane", "3"], SCENE),
    ("a scene that does not exist", ["cone", "nowhere.yaml"], None),
    ("a scene that is a folder", ["cone", "."], None),
    ("a scene without end", ["cone", "/dev/zero"], None),
    ("two scenes in a file", ["cone", "FILE"], SCENE + "---\n" + SCENE),
    ("a scene with an alias of itself", ["cone", "FILE"], "agent: &a [*a]\n"),
    ("a name with a control character", ["cone", "FILE"], 'name: "a\\tb"\n' + SCENE),
    ("cases that are a folder", ["query", "."], None),
    ("cases without end", ["query", "/dev/zero"], None),
    ("a negative seed", ["accuracy", "--seed", "-1"], None),
    ("a seed that is too large", ["campaign", "--seed", "99999999999999999999"], None),
    ("an output folder that cannot be made", ["signmap", "--out", "/proc/vericone"], None),
    ("a scene that is not YAML", ["cone", "FILE"], "agent: [1, 2\nobstacle: }"),
    ("an empty scene", ["cone", "FILE"], ""),
    ("a scene without obstacle", ["cone", "FILE"], SCENE.split("\n")[0]),
    ("a scene with a number in quotes", ["cone", "FILE"], SCENE.replace("[1, 2, 3]", '[1, "2", 3]')),
    ("a scene with .inf", ["cone", "FILE"], SCENE.replace("[1, 2, 3]", "[1, .inf, 3]")),
    ("a scene with a field twice", ["cone", "FILE"], SCENE + "agent: 3\n"),
    ("an unknown method", ["cone", "FILE", "--method", "best"], SCENE),
    ("no planes", ["cone", "FILE", "--method", "slice", "--planes", "0"], SCENE),
    ("planes that are text", ["cone", "FILE", "--method", "slice", "--planes", "many"], SCENE),
    ("two samples", ["cone", "FILE", "--samples", "2"], SCENE),
    ("unknown tangents", ["cone", "FILE", "--method", "slice", "--tangents", "best"], SCENE),
    ("tangents of an exact cone", ["cone", "FILE", "--tangents", "printed"], SCENE),
    ("the source's tangents from a combined agent", ["cone", "FILE", "--method", "slice", "--tangents", "printed"],
     DENTED_SCENE.replace("[1, 2, 3]}", "[1, 2, 3], hyperboloids: [{sheets: 1, semi_axes: [1, 1, 1]}]}")),
    ("samples with a tolerance", ["cone", "FILE", "--samples", "9", "--tolerance", "0.1"], SCENE),
    ("samples of a combined quadric", ["cone", "FILE", "--samples", "9"], DENTED_SCENE),
    ("no tolerance", ["cone", "FILE", "--tolerance", "0"], DENTED_SCENE),
    ("a tolerance below rounding", ["cone", "FILE", "--tolerance", "1e-12"], DENTED_SCENE),
    ("slices of a planar scene", ["cone", "FILE", "--method", "slice"], PLANAR_SCENE),
    ("a tolerance for a planar scene", ["cone", "FILE", "--tolerance", "0.1"], PLANAR_SCENE),
    ("a map of resolution zero", ["cone", "FILE", "--map", "0"], SCENE),
    ("a picture of a planar scene without numbers", ["cone", "FILE", "--picture", "here"],
     PLANAR_SCENE.replace("[9, 0]", "[1.0e200, 0]")),
    ("a map of a planar scene", ["cone", "FILE", "--map", "0.1"], PLANAR_SCENE),
    ("a region without a map", ["cone", "FILE", "--around", "1,0,0"], SCENE),
    ("a region around no direction", ["cone", "FILE", "--map", "0.1", "--around", "0,0,0"], SCENE),
    ("samples of a body of pieces", ["cone", "FILE", "--samples", "9"], PIECES_SCENE),
    ("tangents of a body of pieces", ["cone", "FILE", "--tangents", "printed"], PIECES_SCENE),
    ("two half-planes", ["cone", "FILE", "--planes", "2"], PIECES_SCENE),
    ("no tolerance of half-planes", ["cone", "FILE", "--tolerance", "0"], PIECES_SCENE),
    ("slices of a hull", ["cone", "FILE", "--method", "slice"], PIECES_SCENE),
    ("a polygon in the plane", ["cone", "FILE"],
     "agent: {center: [0, 0], semi_axes: [1, 2]}\nobstacle: {points: [[0, 0], [1, 0], [1, 1]], center: [9, 0]}\n"),
    ("a planar agent before pieces", ["cone", "FILE"],
     "agent: {center: [0, 0], semi_axes: [1, 2]}\nobstacle: {points: [[0, 0, 0], [1, 0, 0], [1, 1, 0]]}\n"),
    ("a word that there is not", ["cone", "FILE"], SCENE.replace("semi_axes: [1, 1, 1]", "torus: {radii: [1, 3]}")),
    ("a pose as a rotation", ["cone", "FILE"], SCENE.replace(
        "[1, 1, 1]", "[1, 1, 1], rotation: [[1, 0, 0, 9], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]")),
    ("a scan without lidars", ["scan", "FILE"], PIECES_SCENE),
    ("a scan with lidars that are no list", ["scan", "FILE"], PIECES_SCENE + "lidars: 2\n"),
    ("a lidar without beams", ["scan", "FILE"], PIECES_SCENE + "lidars: [{position: [0, 0, 1]}]\n"),
    ("a lidar without rows", ["scan", "FILE"], PIECES_SCENE + LIDARS.replace("rows: 9", "rows: 0")),
    ("a lidar with a view of 9 rad", ["scan", "FILE"], PIECES_SCENE + LIDARS.replace("horizontal: 1", "horizontal: 9")),
    ("a lidar of an unknown colour", ["scan", "FILE"], PIECES_SCENE + LIDARS.replace("beams:", "colour: red, beams:")),
    ("a lidar with a range turned over", ["scan", "FILE"],
     PIECES_SCENE + LIDARS.replace("beams:", "min_range: 5, max_range: 1, beams:")),
    ("a lidar that loses all", ["scan", "FILE"], PIECES_SCENE + LIDARS.replace("beams:", "dropout: 2, beams:")),
    ("a lidar towards nothing", ["scan", "FILE"], PIECES_SCENE + LIDARS.replace("beams:", "towards: [0, 0, 0], beams:")),
    ("a negative error of poses", ["scan", "FILE"], PIECES_SCENE + LIDARS + "pose_error: {position: -1}\n"),
    ("a scan of an ellipsoid", ["scan", "FILE"], SCENE + LIDARS),
    ("a scan of a hull", ["scan", "FILE"], PIECES_SCENE + LIDARS),
    ("a page that would be a folder", ["view", "FILE", "--out", "."], SCENE),
    ("a gallery of nothing", ["gallery"], None),
    ("a gallery with a large radius", ["gallery", "nowhere.obj", "--radius", "2"], None),
    ("cases that do not exist", ["query", "nowhere.jsonl"], None),
    ("states that do not exist", ["law", "nowhere.jsonl"], None),
    ("a track that does not exist", ["estimate", "nowhere.csv"], None),
    ("a track without a header", ["estimate", "FILE.csv"], ""),
    ("a track without y", ["estimate", "FILE.csv"], "t,x\n0,1\n"),
    ("a track with an unknown column", ["estimate", "FILE.csv"], "t,x,y,speed\n0,1,2,3\n"),
    ("a track with a column twice", ["estimate", "FILE.csv"], "t,x,y,x\n0,1,2,3\n"),
    ("a track with a word", ["estimate", "FILE.csv"], TRACK + "0.1,one,2\n"),
    ("a track with half a measurement", ["estimate", "FILE.csv"], TRACK + "0.1,1,\n"),
    ("a track that goes back", ["estimate", "FILE.csv"], TRACK + "-0.1,1,2\n"),
    ("a track with a short line", ["estimate", "FILE.csv"], TRACK + "0.1,1\n"),
    ("a track in milliseconds since 1970", ["estimate", "FILE.csv"], "t,x,y\n1731000000000,1,2\n"),
    ("a track without a time", ["estimate", "FILE.csv"], TRACK + ",1,2\n"),
    ("a track with a noise of 0", ["estimate", "FILE.csv"], "t,x,y,r\n0,1,2,0\n"),
    ("a track without a measurement", ["estimate", "FILE.csv"], "t,x,y\n0,,\n0.1,,\n"),
    ("a track with a number out of range", ["estimate", "FILE.csv"], TRACK + "0.1,1e999,2\n"),
    ("a negative alpha", ["estimate", "FILE.csv", "--alpha", "-0.1"], TRACK),
    ("one variance", ["estimate", "FILE.csv", "--variance", "0.1"], TRACK),
    ("a negative variance", ["estimate", "FILE.csv", "--variance", "0.1", "-1"], TRACK),
    ("no noise", ["estimate", "FILE.csv", "--noise", "0"], TRACK),
    ("hidden targets that are guessed", ["estimate", "FILE.csv", "--hidden", "guess"], TRACK),
    ("estimates in a folder that cannot be made", ["estimate", "FILE.csv", "--out", "/proc/vericone"], TRACK),
    ("no engagements", ["accuracy", "--engagements", "0"], None),
    ("a single plane count", ["accuracy", "--planes", "36"], None),
    ("a plane count twice", ["accuracy", "--planes", "36,36"], None),
    ("semi-axes the wrong way round", ["accuracy", "--semi-axes", "2", "1"], None),
    ("a distance at which bodies may overlap", ["accuracy", "--semi-axes", "1", "2", "--distance", "4", "9"], None),
    ("cases that do not exist", ["accuracy", "--cases", "nowhere.jsonl"], None),
    ("cases and a number of random ones", ["accuracy", "--cases", "nowhere.jsonl", "-N", "5"], None),
    ("a case of bodies side by side", ["accuracy", "--cases", "FILE.jsonl"],
     '{"agent": {"center": [0, 0, 0], "semi_axes": [1, 1, 1]}, "obstacle": {"center": [1.5, 0, 0], "semi_axes": [1, 1, 1]}}\n'),
    ("an unknown obstacle", ["accuracy", "--obstacle", "cube"], None),
    ("a tolerance with ellipsoids", ["accuracy", "--tolerance", "0.1"], None),
    ("a tolerance above 1", ["accuracy", "--obstacle", "star", "--tolerance", "2"], None),
    ("a scan with a star", ["accuracy", "--obstacle", "star", "--scan", "FILE.off"], "hello\n"),
    ("a scan that does not exist", ["accuracy", "--scan", "nowhere.off"], None),
    ("a scan that is not one", ["accuracy", "--scan", "FILE.off"], "hello\n"),
]

def rows(points):
    return "".join("%r %r %r\n" % tuple(float(c) for c in p) for p in points)


SPIRAL = [(math.cos(i) * i / 20, math.sin(i) * i / 20, math.cos(2.1 * i)) for i in range(20)]
FLAT = [(x, y, x + 2 * y) for x in range(5) for y in range(4)]
LEVEL = [(x, y, 0.5) for x in range(4) for y in range(3)]
PARABOLOID = [(x / 4, y / 4, (x * x + y * y) / 32) for x in range(-9, 10) for y in range(-9, 10)]
RESULT = {"pieces": [{"quadrics": [[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -1]]]}], "certified": True,
          "coverage": 1, "margin": 0, "certificate": {}}
LEAST = ("--mode", "least-squares")
# What is wrong, arguments after `fit`, the files they name.
FITS = [
    ("a file that is not there", ["nowhere.obj"], {}),
    ("a file of an unknown format", ["scan.dat"], {"scan.dat": "hello\n"}),
    ("an empty file", ["scan.xyz"], {"scan.xyz": ""}),
    ("a truncated mesh", ["scan.off"], {"scan.off": "OFF\n4 4 6\n0 0 0\n1 0 0\n"}),
    ("nothing but NaN", ["scan.xyz"], {"scan.xyz": "nan nan nan\n" * 9}),
    ("a line of text among points", ["scan.xyz"], {"scan.xyz": rows(SPIRAL) + "and so on\n"}),
    ("a mesh without area", ["scan.obj"], {"scan.obj": "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"}),
    ("a map that breaks off", ["scan.bt"], {"scan.bt": "# Octomap OcTree binary file\nid OcTree\n"}),
    ("three points", ["scan.xyz"], {"scan.xyz": rows(SPIRAL[:3])}),
    ("eight points for the nine numbers of an ellipsoid", ["scan.xyz", *LEAST, "--shape", "ellipsoid"],
     {"scan.xyz": rows(SPIRAL[:8])}),
    ("nine points for an ellipsoid with dents", ["scan.xyz", *LEAST, "--shape", "biconcave"],
     {"scan.xyz": rows(SPIRAL[:9])}),
    ("four points for an ellipse", ["scan.xyz", *LEAST, "--shape", "ellipse"], {"scan.xyz": rows(LEVEL[:4])}),
    ("one point many times", ["scan.xyz"], {"scan.xyz": rows(SPIRAL[3:4] * 50)}),
    ("three points many times", ["scan.xyz"], {"scan.xyz": rows(SPIRAL[:3] * 50)}),
    ("eight points many times", ["scan.xyz", *LEAST, "--shape", "ellipsoid"], {"scan.xyz": rows(SPIRAL[:8] * 50)}),
    ("points on a line", ["scan.xyz"], {"scan.xyz": rows((i, 2 * i, 3 * i) for i in range(30))}),
    ("points on a line for an ellipse", ["scan.xyz", "--shape", "ellipse"],
     {"scan.xyz": rows((i, 2 * i, 3 * i) for i in range(30))}),
    ("points above a line for an ellipse", ["scan.xyz", "--shape", "ellipse"],
     {"scan.xyz": rows((i, 2 * i, i * i) for i in range(30))}),
    ("points in a plane for an ellipsoid", ["scan.xyz", "--shape", "ellipsoid"], {"scan.xyz": rows(FLAT)}),
    ("points in a plane for dents", ["scan.xyz", "--shape", "biconcave"], {"scan.xyz": rows(FLAT)}),
    ("points in a plane near a surface", ["scan.xyz", *LEAST, "--shape", "ellipsoid"], {"scan.xyz": rows(FLAT)}),
    ("points of a paraboloid", ["scan.xyz", *LEAST, "--shape", "ellipsoid"], {"scan.xyz": rows(PARABOLOID)}),
    ("an unknown mode", ["scan.xyz", "--mode", "best"], {"scan.xyz": rows(SPIRAL)}),
    ("an unknown shape", ["scan.xyz", "--shape", "cube"], {"scan.xyz": rows(SPIRAL)}),
    ("a coverage of nothing", ["scan.xyz", "--coverage", "0"], {"scan.xyz": rows(SPIRAL)}),
    ("a coverage of more than all", ["scan.xyz", "--coverage", "1.5"], {"scan.xyz": rows(SPIRAL)}),
    ("a coverage that is not a number", ["scan.xyz", "--coverage", "nan"], {"scan.xyz": rows(SPIRAL)}),
    ("a coverage in percent", ["scan.xyz", "--coverage", "95%"], {"scan.xyz": rows(SPIRAL)}),
    ("a negative margin", ["scan.xyz", "--margin", "-0.1"], {"scan.xyz": rows(SPIRAL)}),
    ("an infinite margin", ["scan.xyz", "--margin", "inf"], {"scan.xyz": rows(SPIRAL)}),
    ("a margin where nothing has to be inside", ["scan.xyz", *LEAST, "--margin", "0.1"], {"scan.xyz": rows(SPIRAL)}),
    ("no pieces", ["scan.xyz", "--pieces", "0"], {"scan.xyz": rows(SPIRAL)}),
    ("too many pieces", ["scan.xyz", "--pieces", "65"], {"scan.xyz": rows(SPIRAL)}),
    ("more pieces than the points are enough for", ["scan.xyz", "--pieces", "20"], {"scan.xyz": rows(SPIRAL)}),
    ("a negative seed", ["scan.xyz", "--seed", "-1"], {"scan.xyz": rows(SPIRAL)}),
    ("a file for the folder", ["scan.xyz", "--out", "scan.xyz"], {"scan.xyz": rows(SPIRAL)}),
    ("a folder in a file", ["scan.xyz", "--out", "scan.xyz/fit"], {"scan.xyz": rows(SPIRAL)}),
    ("an agent within the scan", ["scan.xyz", "--cone", "0,0,0,1.5"], {"scan.xyz": rows(SPIRAL)}),
    ("an agent without a radius", ["scan.xyz", "--cone", "5,0,0"], {"scan.xyz": rows(SPIRAL)}),
    ("a check of a result that is not there", ["scan.xyz", "--check", "fit.json"], {"scan.xyz": rows(SPIRAL)}),
    ("a check of what is no JSON", ["scan.xyz", "--check", "fit.json"],
     {"scan.xyz": rows(SPIRAL), "fit.json": "{"}),
    ("a check of what is no result", ["scan.xyz", "--check", "fit.json"],
     {"scan.xyz": rows(SPIRAL), "fit.json": '{"volume": 3}'}),
    ("a check of a quadric that is not symmetric", ["scan.xyz", "--check", "fit.json"],
     {"scan.xyz": rows(SPIRAL), "fit.json": json.dumps(RESULT).replace("[[[1, 0", "[[[1, 2")}),
    ("a check of a certificate without numbers", ["scan.xyz", "--check", "fit.json"],
     {"scan.xyz": rows(SPIRAL), "fit.json": json.dumps(RESULT)}),
    ("a certificate of what is not checked", ["scan.xyz", "--certificate", "c.json"], {"scan.xyz": rows(SPIRAL)}),
    ("a check and a fit at once", ["scan.xyz", "--check", "fit.json", "--shape", "star"],
     {"scan.xyz": rows(SPIRAL), "fit.json": json.dumps(RESULT)}),
]


def png(width, height, grey):
    """A grey picture; grey(u, v) of each pixel."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    lines = b"".join(b"\0" + bytes(grey(u, v) for u in range(width)) for v in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


def street(k, width=64, height=48):
    """A chequered thing of 16 x 10 px, k pixels further to the right, on plain ground."""
    return png(width, height, lambda u, v: (60 + 90 * ((u - k) // 4 % 2 ^ v // 4 % 2)) if 8 + k <= u < 24 + k and 16 <= v < 26 else 100)


FRAMES = {"frames/%d.png" % k: street(k) for k in range(4)}
BOX = ["--box", "8,16,16,10"]
# What is wrong, arguments after `track`, files.
TRACKS = [
    ("a video that is not there", ["none.mp4", *BOX], {}),
    ("a video that is text", ["video.mp4", *BOX], {"video.mp4": b"hello\n"}),
    ("a folder without pictures", ["frames", *BOX], {"frames/notes.txt": b"hello\n"}),
    ("a picture that is cut off", ["frames", *BOX], {**FRAMES, "frames/2.png": street(2)[:70]}),
    ("pictures of two sizes", ["frames", *BOX], {**FRAMES, "frames/3.png": street(3, 66)}),
    ("no boxes", ["frames"], FRAMES),
    ("a box of three numbers", ["frames", "--box", "8,16,16"], FRAMES),
    ("a box of words", ["frames", "--box", "8,16,wide,10"], FRAMES),
    ("a box without width", ["frames", "--box", "8,16,0,10"], FRAMES),
    ("a box that is infinite", ["frames", "--box", "8,16,inf,10"], FRAMES),
    ("a box outside of the picture", ["frames", "--box", "60,16,16,10"], FRAMES),
    ("a second box outside of it", ["frames", *BOX, "--box", "8,-16,16,10"], FRAMES),
    ("a box too small", ["frames", "--box", "8,16,4,3"], FRAMES),
    ("a box without texture", ["frames", "--box", "40,2,16,10"], FRAMES),
    ("a box in frame 0", ["frames", "--box", "8,16,16,10,0"], FRAMES),
    ("a box in a frame after the end", ["frames", "--box", "8,16,16,10,9"], FRAMES),
    ("a tracker that is not there", ["frames", *BOX, "--tracker", "best"], FRAMES),
    ("a truth that is not there", ["frames", *BOX, "--truth", "none.txt"], FRAMES),
    ("a truth without boxes", ["frames", *BOX, "--truth", "truth.txt"], {**FRAMES, "truth.txt": b"\n"}),
    ("a truth of words", ["frames", *BOX, "--truth", "truth.txt"], {**FRAMES, "truth.txt": b"8,16,16,10\na car\n"}),
    ("a truth of another length", ["frames", *BOX, "--truth", "truth.txt"], {**FRAMES, "truth.txt": b"8,16,16,10\n" * 3}),
    ("a truth longer than the video", ["frames", *BOX, "--truth", "truth.txt"],
     {**FRAMES, "truth.txt": b"1,1,8,16,16,10\n7,1,8,16,16,10\n"}),
    ("a truth of other targets", ["frames", *BOX, "--truth", "truth.txt"],
     {**FRAMES, "truth.txt": b"1,1,8,16,16,10\n1,2,8,16,16,10\n"}),
    ("a truth with a box twice", ["frames", *BOX, "--truth", "truth.txt"],
     {**FRAMES, "truth.txt": b"1,1,8,16,16,10\n1,1,8,16,16,10\n"}),
    ("a truth that is half absent", ["frames", *BOX, "--truth", "truth.txt"],
     {**FRAMES, "truth.txt": b"8,16,16,10\nnan,nan,16,10\n"}),
    ("a truth that is never there", ["frames", *BOX, "--truth", "truth.txt"], {**FRAMES, "truth.txt": b"nan,nan,nan,nan\n" * 4}),
    ("a rate of nothing", ["frames", *BOX, "--rate", "0"], FRAMES),
    ("one picture alone", ["frames", *BOX, "--frames", "1"], FRAMES),
]


BODY = "{name: B, shape: {semi_axes: [2, 2, 2]}, position: [20, 0, 0], velocity: [-1, 0, 0]}"
PILOT = "{law: avoidance, most: 15}"


def scenario(body=BODY, pilot=PILOT, agent="{semi_axes: [3, 1, 1]}", top="duration: 5\n"):
    return ("%sbodies:\n  - {name: A, shape: %s, position: [0, 0, 0], speed: 5, heading: [0, 0], pilot: %s}\n  - %s\n"
            % (top, agent, pilot, body))


ORIFICE = "{name: O, opening: {radius: 2}, position: [9, 0, 0], normal: [1, 0, 0]}"
THROUGH = "{law: passage, through: [O], minds: []}"


def orifice(text=ORIFICE, pilot=THROUGH, agent="{semi_axes: [1, 1, 1]}", more=""):
    return scenario(pilot=pilot, agent=agent, top="duration: 5\norifices: [%s%s]\n" % (text, more))


def drone(fields, most=9):
    return ("duration: 9\nstep: 0.1\nbodies:\n"
            "  - name: D\n    shape: {semi_axes: [1, 1, 1]}\n    position: [0, 0, 9]\n    velocity: [4, 0, 0]\n"
            "    vehicle: {kind: quadrotor, %s}\n"
            "    pilot: {law: clearance, most: %s, goal: {point: [0, 30, 0], most: %s}}\n"
            "  - {name: B, shape: {semi_axes: [1, 1, 1]}, position: [90, 0, 0]}\n" % (fields, most, most))


def road(road, more=""):
    return "duration: 5\nbodies:\n  - {name: C, shape: {semi_axes: [1, 1, 1]}, position: [0, 0, 0], %sroad: %s}\n" % (more, road)


def fish(vehicle, shape="", position="[0, 0, 0]", velocity="[0.1, 0, 0]", top=""):
    return "%sduration: 5\nbodies:\n  - {name: F, %sposition: %s, velocity: %s, vehicle: %s}\n" % (top, shape, position, velocity,
                                                                                                vehicle)


CAR = "{name: B, position: [5, 5], road: {kind: lanes, velocity: [20, 0]}}"
CAMERA = "{width: 320, height: 240, field_of_view_deg: 50}"


def pursuit(car=CAR, camera=CAMERA, uas="{position: [0, 0, 120], velocity: [20, 0, 0]}", top="duration: 2\n"):
    return ("%suas: %s\ncars:\n  - %s\ncameras:\n  source: {width: 320, height: 240, field_of_view_deg: 50}\n  perspective: %s\n"
            % (top, uas, car, camera))


# What is wrong, the words after `pursue FILE`, the pursuit.
PURSUITS = [
    ("a field of view of 180 degrees", [], pursuit(camera=CAMERA.replace("50", "180"))),
    ("no field of view", [], pursuit(camera="{width: 320, height: 240}")),
    ("a picture of no pixels", [], pursuit(camera=CAMERA.replace("320", "0"))),
    ("a gimbal that does not turn", [], pursuit(camera=CAMERA.replace("}", ", mount: {kind: gimbal, rate_deg: 0}}"))),
    ("a mount that is not known", [], pursuit(camera=CAMERA.replace("}", ", mount: {kind: glued}}"))),
    ("negative noise", [], pursuit(camera=CAMERA.replace("}", ", noise: -1}"))),
    ("a roof below its bottom", [], pursuit(camera=CAMERA.replace("}", ", occluders: [{center: [0, 0], size: [1, 1], bottom: 5, "
                                                                       "top: 4}]}"))),
    ("a ground that is not there", [], pursuit(camera=CAMERA.replace("}", ", ground: {picture: nowhere.png}}"))),
    ("a camera that is left out", ["--camera", "source"],
     pursuit().replace("  source: {width: 320, height: 240, field_of_view_deg: 50}\n", "")),
    ("no camera at all", ["--camera", "exact"], pursuit().split("cameras:")[0] + "cameras: {}\n"),
    ("a focal law's field of a rendezvous", [], pursuit(top="laws: {source: {kind: rendezvous, stay: 2}}\n")),
    ("a camera under the ground", [], pursuit(uas="{position: [0, 0, -1]}")),
    ("a point mass that climbs", [], pursuit(uas="{position: [0, 0, 120], velocity: [20, 0, 1]}")),
    ("no cars", [], pursuit().replace("cars:\n  - " + CAR, "cars: []")),
    ("two cars of one name", [], pursuit(car=CAR + "\n  - " + CAR)),
    ("a car without a road", [], pursuit(car="{name: B, position: [5, 5]}")),
    ("a road that is not known", [], pursuit(car=CAR.replace("lanes", "spiral"))),
    ("a car that the camera does not see", [], pursuit(car=CAR.replace("[5, 5]", "[5, 500]"))),
    ("pictures between steps", [], pursuit(top="duration: 2\nstep: 0.02\npicture_step: 0.05\n")),
    ("a gain of zero, of a pursuit", [], pursuit(top="duration: 2\nlaws: {source: {kind: rendezvous, cone: 0}}\n")),
    ("a gain by its former name too", [], pursuit(top="duration: 2\nlaws: {source: {kind: focal, cone: 1, K_1: 1}}\n")),
    ("a law of one car for two", [], pursuit(car=CAR + "\n  - " + CAR.replace("B,", "C,"),
                                             top="duration: 2\nlaws: {source: {kind: rendezvous}}\n")),
    ("a variance of one number", [], pursuit(top="duration: 2\nfilters: {ours: {variance: [1]}}\n")),
    ("an unknown field of a pursuit", [], pursuit(top="speed: 2\n")),
    ("an unknown camera", ["--camera", "eagle"], pursuit()),
    ("a video of no pictures", ["--camera", "exact", "--video", "v.mp4"], pursuit()),
    ("a video of another kind", ["--video", "v.gif"], pursuit()),
    ("a pursuit of no time", ["--duration", "0"], pursuit()),
    ("starts and occlusions at once", ["--starts", "3", "--random", "3"], pursuit()),
    ("random occlusions without pictures", ["--random", "3", "--camera", "exact"], pursuit()),
]


# What is wrong, the scenario.
SCENARIOS = [
    ("steps that no memory holds", scenario(top="duration: 5\nstep: 0.000002\n")),
    ("no bodies", "duration: 5\n"),
    ("bodies that are a mapping", "bodies: {A: 1}\n"),
    ("an unknown field of the scenario", scenario(top="durations: 5\n")),
    ("a negative duration", scenario(top="duration: -5\n")),
    ("a step of zero", scenario(top="duration: 5\nstep: 0\n")),
    ("a step far too short", scenario(top="duration: 5\nstep: 1.0e-9\n")),
    ("half a plane logged", scenario(top="duration: 5\nplanes_logged: 0.5\n")),
    ("stopping by a number", scenario(top="duration: 5\nstop_when_passed: 1\n")),
    ("a proof without resolution", scenario(top="duration: 5\nproof: {resolution: 0}\n")),
    ("a body without name", scenario(BODY.replace("name: B, ", ""))),
    ("a name given twice", scenario(BODY.replace("name: B", "name: A"))),
    ("a body without shape", scenario(BODY.replace("shape: {semi_axes: [2, 2, 2]}, ", ""))),
    ("one semi-axis", scenario(BODY.replace("[2, 2, 2]", "[2]"))),
    ("a negative semi-axis", scenario(BODY.replace("[2, 2, 2]", "[2, -2, 2]"))),
    ("two kinds of shape", scenario(BODY.replace("[2, 2, 2]", "[2, 2, 2], points: [[0, 0, 0]]"))),
    ("an ellipsoid with k", scenario(BODY.replace("[2, 2, 2]", "[2, 2, 2], k: 0.5"))),
    ("a planar body in space", scenario(BODY.replace("[2, 2, 2]", "[2, 2]").replace("[20, 0, 0]", "[20, 0]")
                                        .replace("[-1, 0, 0]", "[-1, 0]"))),
    ("dents without k", scenario(BODY.replace("semi_axes:", "dented:"))),
    ("k above 1 at times", scenario(BODY.replace("semi_axes: [2, 2, 2]",
                                                 "dented: [2, 2, 2], k: {offset: 0.5, amplitude: 0.6, rate: 1}"))),
    ("k that changes by text", scenario(BODY.replace("semi_axes: [2, 2, 2]", "dented: [2, 2, 2], k: {rate: fast}"))),
    ("a hull of nothing", scenario(BODY.replace("semi_axes: [2, 2, 2]", "points: []"))),
    ("a position in the plane", scenario(BODY.replace("[20, 0, 0]", "[20, 0]"))),
    ("a heading without a speed", scenario(BODY.replace("velocity: [-1, 0, 0]", "heading: [0, 0]"))),
    ("a velocity and a speed", scenario(BODY.replace("velocity:", "speed: 3, velocity:"))),
    ("a speed without heading", scenario(BODY.replace("velocity: [-1, 0, 0]", "speed: 3"))),
    ("a negative speed", scenario(BODY.replace("velocity: [-1, 0, 0]", "speed: -3, heading: [0, 0]"))),
    ("a heading of one angle in space", scenario(BODY.replace("velocity: [-1, 0, 0]", "speed: 3, heading: 1"))),
    ("an elevation of 100 degrees", scenario(BODY.replace("velocity: [-1, 0, 0]", "speed: 3, heading_deg: [0, 100]"))),
    ("an unknown orientation", scenario(BODY.replace("velocity:", "orientation: upright, velocity:"))),
    ("a level body with a rotation", scenario(BODY.replace("velocity:",
                                                           "orientation: level, rotation: [1, 0, 0, 0], velocity:"))),
    ("a body that appears after the end", scenario(BODY.replace("velocity:", "appears: 7, velocity:"))),
    ("a law that is not there", scenario(pilot="{law: dodge}")),
    ("a pilot without law", scenario(pilot="{most: 15}")),
    ("a gain of zero", scenario(pilot="{law: avoidance, gain: 0}")),
    ("a saturation of zero", scenario(pilot="{law: avoidance, most: 0}")),
    ("both sides at once", scenario(pilot="{law: avoidance, side: 0}")),
    ("an unknown choice of planes", scenario(pilot="{law: avoidance, plane: {choice: best}}")),
    ("wind without wind", scenario(pilot="{law: avoidance, plane: {choice: wind-aware}}")),
    ("mu for one", scenario(pilot="{law: avoidance, mu: -0.5}")),
    ("a sector of the clearance law", scenario(pilot="{law: clearance, sector: exact}")),
    ("a negative clearance", scenario(pilot="{law: clearance, clearance: {required: -1}}")),
    ("minding nobody known", scenario(pilot="{law: avoidance, minds: [C]}")),
    ("a partner with a pilot", scenario(BODY.replace("velocity:", "pilot: {law: avoidance}, velocity:"),
                                        "{law: cooperative-avoidance, partners: [B]}")),
    ("a goal without most", scenario(pilot="{law: avoidance, goal: {point: [9, 0, 0]}}")),
    ("noise that is not known", scenario(pilot="{law: clearance, sensor: {noise: loud}}")),
    ("a negative deviation", scenario(pilot="{law: clearance, sensor: {noise: isotropic, position: -1, velocity: 0}}")),
    ("noise of (7.2) for a law that does not read it", scenario(pilot="{law: clearance, sensor: {noise: engagement, r: 0.2}}")),
    ("an estimator without a sensor", scenario(pilot="{law: clearance, estimator: {kind: state}}")),
    ("an estimator that is not known", scenario(pilot="{law: clearance, sensor: {noise: isotropic, position: 1, velocity: 1}, "
                                                "estimator: {kind: best}}")),
    ("a filter of nothing", scenario(pilot="{law: avoidance, manner: source, filter: {of: []}}")),
    ("a filter of another law", scenario(pilot="{law: clearance, filter: {of: [y]}}")),
    ("an outer loop whose least b is above its most", scenario(
        pilot="{law: avoidance, manner: source, most: 5, robust: {nu: 1, lambda: 0.1, b_min: 0.2, mu: 1, Q: 1, R: 0}}")),
    ("an outer loop without limit", scenario(pilot="{law: avoidance, manner: source, robust: {nu: 1, lambda: 0.1, mu: 1, Q: 1, "
                                             "R: 0}}")),
    ("an outer loop of a guarded pilot", scenario(pilot="{law: avoidance, most: 5, robust: {nu: 1, lambda: 0.1, mu: 1, Q: 1, "
                                                  "R: 0}}")),
    ("half a seed", scenario(top="duration: 5\nseed: 0.5\n")),
    ("a goal after nobody", scenario(pilot="{law: avoidance, goal: {point: [9, 0, 0], most: 5, after: C}}")),
    ("a hull that flies by slices", scenario(agent="{points: [[0, 0, 0], [1, 0, 0]]}",
                                              pilot="{law: avoidance, manner: source, sector: slice}")),
    ("an opening whose outline crosses itself", orifice(ORIFICE.replace("radius: 2", "polygon: [[0, 0], [2, 2], [2, 0], [0, 2]]"))),
    ("an opening of two corners", orifice(ORIFICE.replace("radius: 2", "polygon: [[0, 0], [2, 2]]"))),
    ("an opening of two kinds", orifice(ORIFICE.replace("radius: 2", "radius: 2, semi_axes: [1, 2]"))),
    ("an opening without radius", orifice(ORIFICE.replace("radius: 2", "radius: 0"))),
    ("an orifice that faces nowhere", orifice(ORIFICE.replace("[1, 0, 0]", "[0, 0, 0]"))),
    ("an orifice without attitude", orifice(ORIFICE.replace(", normal: [1, 0, 0]", ""))),
    ("a spin of two numbers", orifice(ORIFICE.replace("normal:", "spin: [0, 1], normal:"))),
    ("an orifice faster than all there is", orifice(ORIFICE.replace("normal:", "velocity: [0, 0, 1.0e30], normal:"))),
    ("a wall by a number", orifice(ORIFICE.replace("normal:", "wall: 1, normal:"))),
    ("two orifices of one name", orifice(more=", " + ORIFICE)),
    ("an orifice called as a body", orifice(ORIFICE.replace("name: O", "name: A"))),
    ("a law of orifices without through", orifice(pilot="{law: passage}")),
    ("through an orifice that is not there", orifice(pilot="{law: passage, through: [P]}")),
    ("through of a law of bodies", orifice(pilot="{law: avoidance, through: [O]}")),
    ("w above 0", orifice(pilot="{law: orifice, through: [O], reference: 0.1}")),
    ("w below what y can be", orifice(pilot="{law: orifice, through: [O], reference: -1.5}")),
    ("the source's law without w", orifice(pilot="{law: orifice, through: [O]}")),
    ("the source's law for an agent too large", orifice(agent="{semi_axes: [3, 1, 1]}",
                                                       pilot="{law: orifice, through: [O], reference: -0.1}")),
    ("a negative margin", orifice(pilot="{law: passage, through: [O], margin: -1}")),
    ("a body that a law of orifices does not see", orifice(pilot="{law: passage, through: [O]}")),
    ("bodies of a law of orifices", orifice(pilot="{law: passage, through: [O], minds: [B]}")),
    ("a body and a position", scenario("{name: B, center: [20, 0, 0], semi_axes: [2, 2, 2], position: [1, 0, 0]}")),
    ("a mesh that is not there", scenario(BODY.replace("semi_axes: [2, 2, 2]", "mesh: none.off"))),
    ("a shape of no pieces", scenario(BODY.replace("semi_axes: [2, 2, 2]", "pieces: []"))),
    ("a piece with dents beside a hull", scenario(BODY.replace(
        "semi_axes: [2, 2, 2]", "pieces: [{center: [0, 0, 0], semi_axes: [1, 1, 1], hyperboloids: [{sheets: 2, "
                                "semi_axes: [0.5, 1, 1]}]}, {points: [[0, 0, 0]]}]"))),
    ("a margin of a body that changes", scenario(BODY.replace("semi_axes:", "k: 0.5, margin: 1, dented:"))),
    ("a margin of a body in the plane", scenario(BODY.replace("[2, 2, 2]", "[2, 2], margin: 1"))),
    ("a capsule with a height", scenario(BODY.replace("semi_axes: [2, 2, 2]", "capsule: {radius: 1, height: 2}"))),
    ("a fish above the water", fish("{kind: fish, depth: -1}")),
    ("a fish with more gas than its chamber holds", fish("{kind: fish, gas: 1.0e-5}")),
    ("a fish that can never rise", fish("{kind: fish, neutral_gas: 9.0e-6}")),
    ("a fish of negative mass", fish("{kind: fish, mass: -0.8}")),
    ("a fish whose hinge is behind its body", fish("{kind: fish, hinge: 0.3}")),
    ("a tail that folds over", fish("{kind: fish, most_bias_deg: 60}")),
    ("a vehicle without a kind", fish("{depth: 3}")),
    ("a vehicle of an unknown kind", fish("{kind: submarine}")),
    ("an unknown field of a fish", fish("{kind: fish, colour: red}")),
    ("a limit of nothing", fish("{kind: fish, limits: {speed: 0}}")),
    ("a trial under control", fish("{kind: fish, trial: {amplitude_deg: 20}}")),
    ("an amplitude beyond its most", fish("{kind: fish, control: none, trial: {amplitude_deg: 40}}")),
    ("a shape and the vehicle's own", fish("{kind: fish, body: sphere}", "shape: {semi_axes: [1, 1, 1]}, ")),
    ("a vehicle in the plane", fish("{kind: fish}", "shape: {semi_axes: [1, 1]}, ", "[0, 0]", "[1, 0]")),
    ("a quadrotor without a shape", fish("{kind: quadrotor}")),
    ("a quadrotor that cannot hover", drone("most_thrust: 40")),
    ("a quadrotor of two moments of inertia", drone("inertia: [0.1, 0.1]")),
    ("a quadrotor of an inertia that no body has", drone("inertia: [0.1, 0.1, 0.3]")),
    ("a quadrotor on its side", drone("most_tilt_deg: 90")),
    ("thrust and torques held for too long", drone("period: 0.02")),
    ("a negative drag", drone("drag: [0, -1, 0]")),
    ("wind for a quadrotor without drag", "current: {uniform: [3, 0, 0]}\n" + drone("mass: 4")),
    ("gusts too short for a quadrotor", "current: {gusts: {most: 1, shortest: 0.05}}\n" + drone("drag: [1, 1, 1]")),
    ("a current that moves nothing", scenario(top="duration: 5\ncurrent: {uniform: [3, 0, 0]}\n")),
    ("a quadrotor that tumbles", drone("gain_rate: 0.2, period: 0.001, most_tilt_deg: 80, most_thrust: 400", 90)),
    ("an unknown field of a quadrotor", drone("depth: 3")),
    ("a quadrotor that starts upright", fish("{kind: quadrotor}", "shape: {semi_axes: [1, 1, 1]}, ", velocity="[0, 0, 1]")),
    ("a road of an unknown kind", road("{kind: motorway}")),
    ("a road and a velocity", road("{kind: lanes, velocity: [1, 0]}", "velocity: [1, 0, 0], ")),
    ("a road and a pilot", road("{kind: lanes, velocity: [1, 0]}", "pilot: {law: avoidance, most: 1}, ")),
    ("a lane without a velocity", road("{kind: lanes}")),
    ("a change of the lane at rest", road("{kind: lanes, velocity: [0, 0], changes: [{at: 1, acceleration: 1}]}")),
    ("a change of the lane before the start", road("{kind: lanes, velocity: [1, 0], changes: [{at: -1, acceleration: 1}]}")),
    ("a change of the lane that takes no time",
     road("{kind: lanes, velocity: [1, 0], changes: [{at: 1, acceleration: 1, seconds: 0}]}")),
    ("a squircle with corners", road("{kind: squircle, radius: 9, period: 9, squareness: 1}")),
    ("a squircle of no size", road("{kind: squircle, radius: 0, period: 9}")),
    ("a fish that starts upright", fish("{kind: fish}", velocity="[0, 0, 0.1]")),
    ("a current of two numbers", fish("{kind: fish}", top="current: {uniform: [1, 0]}\n")),
    ("a shear without a rate", fish("{kind: fish}", top="current: {shear: {level: 1}}\n")),
    ("gusts whose longest period is the shorter", fish("{kind: fish}", top="current: {gusts: {most: 1, longest: 1}}\n")),
    ("a current with an unknown field", fish("{kind: fish}", top="current: {wind: 1}\n")),
]
# What is wrong, arguments after `campaign`.
COMMANDS += [
    ("a scenario for a scene", ["cone", "FILE"], scenario()),
    ("a scene for a scenario", ["simulate", "FILE"], SCENE),
    ("a scene for a pursuit", ["pursue", "FILE"], SCENE),
    ("a pursuit for a scene", ["cone", "FILE"], pursuit()),
    ("a scan for a scene", ["check", "FILE.off"], "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
    ("a body for a scenario", ["trials", "FILE"], "{center: [0, 0, 0], semi_axes: [1, 2, 3]}\n"),
]


def population(drawn="{obstacle: {y: {normal: [0, 1]}}}", more=""):
    return ("agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: {center: [9, 0, 0], semi_axes: [1, 1, 1]}\n"
            "agent_velocity: [1, 0, 0]\ndrawn: %s\n%s" % (drawn, more))


COMMANDS += [(what, ["campaign", "--verdicts", "FILE", *more], text) for what, text, *more in (
    ("a scene for a population", SCENE),
    ("nothing drawn", population("{agent: {}}")),
    ("a quantity that no body has", population("{agent: {mass: {uniform: [1, 2]}}}")),
    ("two distributions of one number", population("{agent: {x: {uniform: [1, 2], normal: [0, 1]}}}")),
    ("a uniform distribution upside down", population("{agent: {x: {uniform: [2, 1]}}}")),
    ("a deviation of zero", population("{agent: {x: {normal: [2, 0]}}}")),
    ("a speed that may be negative", population("{agent: {speed: {normal: [10, 3]}}}")),
    ("a semi-axis that may be zero", population("{agent: {a: {uniform: [0, 3]}}}")),
    ("semi-axes of a body without", population("{obstacle: {a: {uniform: [1, 3]}}}").replace(
        "obstacle: {center: [9, 0, 0], semi_axes: [1, 1, 1]}", "obstacle: {center: [9, 0, 0], cylinder: {radius: 1, height: 2}}")),
    ("a negative concentration", population("{agent: {course: {von_mises: [0, -1]}}}")),
    ("an elevation beyond the zenith", population("{agent: {climb: {elevation: [0, 2]}}}")),
    ("a speed in metres", population("{agent: {vx: {normal: [0, 3 m]}}}")),
    ("edges as many as weights", population("{agent: {x: {table: {edges: [0, 1], weights: [1, 2]}}}}")),
    ("edges that go back", population("{agent: {x: {table: {edges: [0, 2, 1], weights: [1, 2]}}}}")),
    ("weights of zero", population("{agent: {x: {table: {edges: [0, 1], weights: [0]}}}}")),
    ("a speed beside components", population("{agent: {speed: {uniform: [1, 2]}, vx: {uniform: [1, 2]}}}")),
    ("a proposal for what is not drawn", population(more="proposal: {agent: {x: {normal: [0, 1]}}}\n")),
    ("no nominal share", population(more="nominal_share: 0\n")),
    ("correlated with what is not drawn", population(more="correlated: [{of: [obstacle.y, obstacle.x], correlations: [[1, 0], [0, 1]]}]\n")),
    ("a correlation of one", population("{obstacle: {y: {normal: [0, 1]}, z: {normal: [0, 1]}}}",
                                        "correlated: [{of: [obstacle.y, obstacle.z], correlations: [[1, 1], [1, 1]]}]\n")),
    ("many velocities of one place", population("{agent: {vy: {normal: [0, 1]}}}", "velocities: 10\n")),
    ("many velocities beside a proposal", population(more="velocities: 10\nproposal: {obstacle: {y: {normal: [0, 2]}}}\n")),
    ("a law of verdicts", population(), "--laws", "slice"),
    ("no verdicts", population(), "-N", "0"),
)]
QUERIES.insert(1, ("a misspelt kind of body", case(obstacle={"shape": ..., "meshes": "a.obj"})))

CAMPAIGNS = [
    ("no engagements", ["-N", "0"]),
    ("an unknown law", ["--laws", "slice,best"]),
    ("a law twice", ["--laws", "slice,slice"]),
    ("no saturation", ["--most", "0"]),
    ("a saturation that is none", ["--most", "5000"]),
    ("a negative gain", ["--gain", "-1"]),
    ("no clearance", ["--required", "0"]),
    ("a step of zero", ["--step", "0"]),
    ("many threads", ["--threads", "5000"]),
]
# What is wrong, arguments after `trials scenario.yaml`: a scenario with a pilot and without a sensor.
TRIALS = [
    ("no trials", ["-N", "0"]),
    ("no levels", ["--levels", ""]),
    ("a level that is no noise", ["--levels", "5"]),
    ("a negative level", ["--levels", "5:-10"]),
    ("a level twice", ["--levels", "5:10,5:10"]),
    ("times a sensor that is not there", ["--levels", "x2"]),
    ("an unknown law", ["--laws", "di,best"]),
    ("a law twice", ["--laws", "di,di"]),
]


def once(run):
    """The same question again: what it said the first time."""
    said = {}

    def asked(*question):
        key = repr(question)
        if key not in said:
            said[key] = run(*question)
        return said[key]
    return asked


def run_queries(vericone, cases=None, command="query"):
    lines = [q if isinstance(q, str) else json.dumps(q) for _, q in cases or QUERIES]
    with tempfile.TemporaryDirectory() as folder:
        for name, content in FILES.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as f:
                f.write(content)
        result = subprocess.run([vericone, command, "-"], input="\n".join(lines) + "\n", capture_output=True, text=True,
                                check=False, cwd=folder)
    answers = [json.loads(line) for line in result.stdout.splitlines()]
    return lines, answers, result


@once
def run_command(vericone, arguments, scene):
    with tempfile.TemporaryDirectory() as folder:
        name = {"FILE.off": "scan.off", "FILE.csv": "track.csv"}.get(
            next((a for a in arguments if a.startswith("FILE")), ""), "scene.yaml")
        if scene is not None:
            with open(os.path.join(folder, name), "w", encoding="utf-8") as f:
                f.write(scene)
        arguments = [name if a.startswith("FILE") else a for a in arguments]
        result = subprocess.run([vericone] + arguments, capture_output=True, text=True, check=False, cwd=folder)
        return arguments, result, os.listdir(folder)


@once
def run_fit(vericone, arguments, files):
    with tempfile.TemporaryDirectory() as folder:
        for name, content in files.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as f:
                f.write(content)
        result = subprocess.run([vericone, "fit", *arguments, "--quiet"], capture_output=True, text=True, check=False,
                                cwd=folder)
        return result, sorted(set(os.listdir(folder)) - set(files))


@once
def run_track(vericone, arguments, files):
    with tempfile.TemporaryDirectory() as folder:
        for name, content in files.items():
            os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
            with open(os.path.join(folder, name), "wb") as f:
                f.write(content)
        result = subprocess.run([vericone, "track", *arguments, "--no-figures", "--quiet"], capture_output=True, text=True,
                                check=False, cwd=folder)
        return result, sorted(set(os.listdir(folder)) - {name.split("/")[0] for name in files})


def run_scenario(vericone, text):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scenario.yaml"), "w", encoding="utf-8") as f:
            f.write(text)
        result = subprocess.run([vericone, "simulate", "scenario.yaml", "--quiet"], capture_output=True, text=True,
                                check=False, cwd=folder)
        return result, sorted(set(os.listdir(folder)) - {"scenario.yaml"})


def run_campaign(vericone, arguments):
    with tempfile.TemporaryDirectory() as folder:
        result = subprocess.run([vericone, "campaign", *arguments, "--quiet"], capture_output=True, text=True,
                                check=False, cwd=folder)
        return result, os.listdir(folder)


def run_trials(vericone, arguments):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scenario.yaml"), "w", encoding="utf-8") as f:
            f.write(scenario(pilot="{law: avoidance, manner: source, most: 5}"))
        result = subprocess.run([vericone, "trials", "scenario.yaml", *arguments, "--quiet"], capture_output=True, text=True,
                                check=False, cwd=folder)
        return result, sorted(set(os.listdir(folder)) - {"scenario.yaml"})


def run_pursuit(vericone, arguments, text):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "pursuit.yaml"), "w", encoding="utf-8") as f:
            f.write(text)
        result = subprocess.run([vericone, "pursue", "pursuit.yaml", *arguments, "--no-figures", "--quiet"], capture_output=True,
                                text=True, check=False, cwd=folder)
        return result, sorted(set(os.listdir(folder)) - {"pursuit.yaml"})


def answers(vericone):
    """(section, [(what, message)]) of all cases."""
    def lines(cases, command):
        _, found, _ = run_queries(vericone, cases, command)
        return [(what, answer.get("error", "no error")) for (what, _), answer in zip(cases, found)]

    def said(cases, runs):
        return [(case[0], runs(*case[1:]).stderr) for case in cases]

    yield "Lines of `vericone query`", lines(QUERIES, "query")
    yield "Lines of `vericone law`", lines(LAWS, "law")
    yield "Commands and scenes", said(COMMANDS, lambda arguments, scene: run_command(vericone, arguments, scene)[1])
    yield "Fits", said(FITS, lambda arguments, files: run_fit(vericone, arguments, files)[0])
    yield "Tracks", said(TRACKS, lambda arguments, files: run_track(vericone, arguments, files)[0])
    yield "Scenarios", said(SCENARIOS, lambda text: run_scenario(vericone, text)[0])
    yield "Tracks of others", said(certify_cases.CASES, lambda text: certify_cases.run_tracks(vericone, text)[0])
    yield "Pursuits", said(PURSUITS, lambda arguments, text: run_pursuit(vericone, arguments, text)[0])
    yield "Campaigns", said(CAMPAIGNS, lambda arguments: run_campaign(vericone, arguments)[0])
    yield "Trials", said(TRIALS, lambda arguments: run_trials(vericone, arguments)[0])


def kind(message):
    """The same of messages that ask for the same: the first words of what must be, without numbers."""
    if "an unknown field" in message:
        return "unknown field"
    wanted = message.split(", must be ", 1)[-1]
    words = re.split(r"[;:(,]", re.sub(r"[-+]?\d[\d.e+-]*", "N", wanted))[0].split()
    return " ".join(words[:2])


def table(vericone):
    text = ["# What bad input gets", "",
            "One line that names the field, the value and what would be right; exit status 2; nothing half written. In a file of",
            "cases the run goes on with the next line and ends with 2. Below stands one example of each kind of message, where it",
            "comes first; long ones are cut off. `tests/cli` tries all cases, of which there are several hundred, and makes and",
            "checks this page."]
    seen = set()
    for section, cases in answers(vericone):
        text += ["", "## " + section, "", "| what | message |", "|---|---|"]
        for what, message in cases:
            if kind(message) in seen:
                continue
            seen.add(kind(message))
            message = " ".join(message.removeprefix("vericone: ").split()).replace("|", "\\|")
            text.append("| %s | `%s` |" % (what, message if len(message) <= 160 else message[:157] + "..."))
    return "\n".join(text) + "\n"


if __name__ == "__main__":
    sys.stdout.write(table(os.path.abspath(sys.argv[1])))
