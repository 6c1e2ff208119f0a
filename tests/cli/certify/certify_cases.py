# SPDX-License-Identifier: BSD-3-Clause
"""Bad inputs of `vericone certify`, for bad_input_cases.py and certify_test.py."""
import os
import subprocess
import tempfile

# Files in the folder that the command runs in.
FILES = {"eight.csv": "duration,x^0,x^1,y^0,z^0\n1,0,1,0,0\n1,1,1,0,0\n",
         "torn.csv": "duration,x^0,x^1,y^0,z^0\n1,0,1,0,0\n1,1.5,1,0,0\n",
         "still.csv": "duration,x^0,x^1,y^0,z^0\n0,0,1,0,0\n",
         "text.csv": "duration,x^0,x^1,y^0,z^0\n1,0,1,0,much\n",
         "short.csv": "duration,x^0,x^1,y^0,z^0\n1,0,1,0\n",
         "ten.csv": "duration,x^10,x^0,y^0\n1,0,1,0\n",
         "poses.tum": "# t x y z qx qy qz qw\n0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n",
         "long.tum": "0 0 0 0 0 0 0 2\n1 1 0 0 0 0 0 1\n",
         "back.tum": "0 0 0 0 0 0 0 1\n0 1 0 0 0 0 0 1\n",
         "half.tum": "0 0 0 0 0 0 0 1\n1 1 0 0 1 0 0 0\n",
         "five.tum": "0 0 0 0 0\n1 1 0 0 0\n",
         "poses.kitti": "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n",
         "bent.kitti": "1 0 0 0 0 2 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n",
         "times.txt": "0\n1\n2\n",
         "empty.csv": "# nothing\n"}
TRACK = "{kind: powers, times: [0, 2], pieces: [[[0, 0, 0], [1, 0, 0]]]}"


def tracks(track=TRACK, more="", shape="{semi_axes: [1, 1, 1]}", top=""):
    """Two bodies, of which one has this track and these fields more."""
    return (f"{top}bodies:\n  - {{name: A, shape: {shape}, track: {track}{more}}}\n"
            "  - {name: B, shape: {semi_axes: [1, 1, 1]}, position: [9, 0, 0]}\n")


CASES = [
    ("no bodies", "name: nothing\n"),
    ("bodies that are none", "bodies: []\n"),
    ("an unknown field of tracks", tracks(top="sharp: 1\n")),
    ("a negative required distance", tracks(top="required: -1\n")),
    ("an end before the beginning", tracks(top="from: 5\nto: 1\n")),
    ("a resolution of zero", tracks(top="resolution: 0\n")),
    ("a body of tracks without name", "bodies: [{shape: {semi_axes: [1, 1, 1]}}]\n"),
    ("a body of tracks without shape", "bodies: [{name: A}]\n"),
    ("two bodies of tracks of one name", tracks().replace("name: B", "name: A")),
    ("no track, and no times", "bodies: [{name: A, shape: {semi_axes: [1, 1, 1]}}]\n"),
    ("a negative radius", tracks(more=", radius: -0.1")),
    ("a speed limit of zero", tracks(more=", limits: {speed: 0}")),
    ("an unknown limit", tracks(more=", limits: {jerk: 1}")),
    ("limits of a body without track", tracks().replace("position:", "limits: {speed: 1}, position:")),
    ("a velocity beside a track", tracks(more=", velocity: [1, 0, 0]")),
    ("a planar body among solid ones", tracks(shape="{semi_axes: [1, 1]}")),
    ("a track without kind", tracks("{times: [0, 1]}")),
    ("a track of an unknown kind", tracks("{kind: bezier}")),
    ("an unknown field of a track", tracks("{kind: powers, file: eight.csv, order: 3}")),
    ("a field of another kind of track", tracks("{kind: powers, file: eight.csv, knots: [0, 1]}")),
    ("powers of nothing", tracks("{kind: powers}")),
    ("times without pieces", tracks("{kind: powers, times: [0, 1]}")),
    ("a time too few", tracks("{kind: powers, times: [0, 1], pieces: [[[0, 0, 0]], [[0, 0, 0]]]}")),
    ("times that stand still", tracks("{kind: powers, times: [0, 0], pieces: [[[0, 0, 0]]]}")),
    ("a polynomial of degree 10", tracks("{kind: powers, times: [0, 1], pieces: [[%s]]}" % ", ".join(["[0, 0, 0]"] * 11))),
    ("a coefficient that is none", tracks("{kind: powers, times: [0, 1], pieces: [[[0, 0, .nan]]]}")),
    ("a coefficient of four numbers", tracks("{kind: powers, times: [0, 1], pieces: [[[0, 0, 0, 0]]]}")),
    ("a file beside times", tracks("{kind: powers, file: eight.csv, times: [0, 1]}")),
    ("a file that is not there", tracks("{kind: powers, file: nine.csv}")),
    ("pieces that miss each other", tracks("{kind: powers, file: torn.csv}")),
    ("a piece of no time", tracks("{kind: powers, file: still.csv}")),
    ("a coefficient of text", tracks("{kind: powers, file: text.csv}")),
    ("a coefficient that is missing", tracks("{kind: powers, file: short.csv}")),
    ("a power of ten", tracks("{kind: powers, file: ten.csv}")),
    ("poses where powers should be", tracks("{kind: powers, file: poses.tum}")),
    ("a file without numbers", tracks("{kind: powers, file: empty.csv}")),
    ("control points that jump", tracks("{kind: bernstein, times: [0, 1, 2], pieces: [[[0, 0, 0]], [[1, 0, 0]]]}")),
    ("a file of control points of pieces", tracks("{kind: bernstein, file: eight.csv}")),
    ("a spline without knots", tracks("{kind: spline, points: [[0, 0, 0], [1, 0, 0], [1, 0, 0], [1, 0, 0]]}")),
    ("a knot too few", tracks("{kind: spline, degree: 1, knots: [0, 1, 2], points: [[0, 0, 0], [1, 0, 0]]}")),
    ("knots that descend", tracks("{kind: spline, degree: 1, knots: [0, 1, 0, 2], points: [[0, 0, 0], [1, 0, 0]]}")),
    ("too few control points", tracks("{kind: spline, interval: 1, points: [[0, 0, 0], [1, 0, 0]]}")),
    ("a degree of ten", tracks("{kind: spline, degree: 10, interval: 1, points: [[0, 0, 0]]}")),
    ("knots beside an interval", tracks("{kind: spline, degree: 1, interval: 1, knots: [0, 1, 2, 3], points: [[0, 0, 0], "
                                        "[1, 0, 0]]}")),
    ("a yaw that ends too early", tracks("{kind: spline, degree: 1, interval: 1, yaw: [0, 1], points: [[0, 0, 0], [1, 0, 0], "
                                         "[2, 0, 0]]}")),
    ("poses that go back", tracks("{kind: poses, file: back.tum}")),
    ("a quaternion of length 2", tracks("{kind: poses, file: long.tum}")),
    ("half a turn from pose to pose", tracks("{kind: poses, file: half.tum}")),
    ("five columns without names", tracks("{kind: poses, file: five.tum}")),
    ("poses without times", tracks("{kind: poses, file: poses.kitti}")),
    ("times in two ways", tracks("{kind: poses, file: poses.kitti, interval: 1, times_file: times.txt}")),
    ("a time too many", tracks("{kind: poses, file: poses.kitti, times_file: times.txt}")),
    ("a matrix that is no rotation", tracks("{kind: poses, file: bent.kitti, interval: 0.1 s}")),
    ("an interval of poses with times", tracks("{kind: poses, file: poses.tum, interval: 0.1}")),
    ("an interval in metres", tracks("{kind: poses, file: poses.kitti, interval: 1 m}")),
    ("velocities of straight lines", tracks("{kind: poses, times: [0, 1], points: [[0, 0, 0], [1, 0, 0]], velocities: "
                                            "[[1, 0, 0], [1, 0, 0]]}")),
    ("a rotation too few", tracks("{kind: poses, times: [0, 1], points: [[0, 0, 0], [1, 0, 0]], rotations: [[1, 0, 0, 0]]}")),
    ("an unknown orientation of a track", tracks("{kind: poses, file: poses.tum, orientation: heading}")),
    ("an orientation beside rotations", tracks("{kind: poses, file: poses.tum, orientation: level}")),
    ("a track along its velocity that stands still", tracks("{kind: powers, times: [0, 2], pieces: [[[0, 0, 0], [0, 0, 0], [1, 0, 0]]], "
                                                            "orientation: level}")),
    ("a track along its velocity with corners", tracks("{kind: poses, times: [0, 1, 2], points: [[0, 0, 0], [1, 0, 0], [1, 1, 0]], "
                                                       "orientation: level}")),
    ("an unknown way between poses", tracks("{kind: poses, file: poses.tum, between: cubic}")),
]


def run_tracks(vericone, text):
    """What the command says, and what it leaves behind."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in {**FILES, "tracks.yaml": text}.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(content)
        result = subprocess.run([vericone, "certify", "tracks.yaml", "--quiet", "--certificate", "out.json"],
                                capture_output=True, text=True, check=False, cwd=folder)
        return result, sorted(set(os.listdir(folder)) - set(FILES) - {"tracks.yaml"})
