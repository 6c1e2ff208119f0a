/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The core of vericone for C, and for all languages that can call it: bodies, pairs, cones, a navigator.
 *
 * Lengths in metres, times in seconds, angles in radians, right-handed axes. A vector is three doubles; a
 * rotation is nine, row by row, and takes the body's axes to the world's; NULL: not turned.
 *
 * What makes an object returns it, or NULL; all else returns its answer, 0 or more, or an error below 0.
 * After an error vericone_error() says which, in one line. Nothing throws, nothing ends the program. Objects
 * but navigators never change: several threads may use one at a time. Each is released by the function named
 * *_free, which takes NULL too; a pair keeps what it needs of its bodies. Outputs may be NULL where they are
 * not wanted.
 *
 * Structs and numbers stay as they are for as long as the library is libvericone_c.so.1. */
#ifndef VERICONE_C_H
#define VERICONE_C_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define VERICONE_API __attribute__((visibility("default")))
#else
#define VERICONE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Errors ---- */

enum vericone_status {
  VERICONE_OK = 0,
  VERICONE_BAD_INPUT = -1, /* vericone_error(): "FIELD: got VALUE, must be REQUIREMENT" */
  VERICONE_NO_MEMORY = -2,
  VERICONE_FAILED = -3 /* a defect of the library */
};

/* The last error of this thread, one line; "" before the first one. Valid until its next one. */
VERICONE_API const char* vericone_error(void);
/* "0.1.0" */
VERICONE_API const char* vericone_version(void);
/* VERICONE_OK where the arithmetic of this thread is that on which every answer rests: doubles of IEEE 754,
 * rounded to nearest, subnormal ones kept. Ask at the start of a program, and of a thread whose modes others
 * may have set: what is linked with -ffast-math takes them away. 40 ns. */
VERICONE_API int32_t vericone_sound_arithmetic(void);

/* ---- Bodies ---- */

typedef struct vericone_body vericone_body;

enum vericone_kind {
  VERICONE_ELLIPSOID,
  VERICONE_COMBINED, /* an ellipsoid cut by hyperboloids: dents, waists, stars */
  VERICONE_HULL,
  VERICONE_MESH, /* triangles, without what they enclose */
  VERICONE_CLOUD,
  VERICONE_BOXES,
  VERICONE_PIECES,
  VERICONE_CONVEX /* a cylinder, a capsule, one of the others with a margin */
};

/* About the body's own origin, its semi-axes those of `rotation`'s columns. */
VERICONE_API vericone_body* vericone_body_ellipsoid(const double center[3], const double semi_axes[3],
                                                    const double rotation[9]);

/* Cuts an ellipsoid about the same centre: what lies inside two sheets is taken away (two dents), or what
 * lies outside of one (a waist). `semi_axes`: the first along its axis. `rotation`: against the body's axes;
 * all zero: not turned. */
typedef struct vericone_hyperboloid {
  double semi_axes[3];
  double rotation[9];
  int32_t sheets; /* 1 or 2 */
} vericone_hyperboloid;
VERICONE_API vericone_body* vericone_body_combined(const double center[3], const double semi_axes[3],
                                                   const double rotation[9],
                                                   const vericone_hyperboloid* hyperboloids, size_t count);

/* The solid convex hull of points, xyz by xyz. */
VERICONE_API vericone_body* vericone_body_hull(const double* points, size_t count);
/* The solid box between two opposite corners. */
VERICONE_API vericone_body* vericone_body_box(const double low[3], const double high[3]);
/* Triangles of three indices into the points each. */
VERICONE_API vericone_body* vericone_body_mesh(const double* points, size_t count, const uint32_t* triangles,
                                               size_t triangle_count);
/* Balls of one radius, 0 or more, about points. */
VERICONE_API vericone_body* vericone_body_cloud(const double* points, size_t count, double radius);
/* Solid boxes, low xyz and high xyz of each: the occupied cells of a map. */
VERICONE_API vericone_body* vericone_body_boxes(const double* boxes, size_t count);
/* The union of ellipsoids and combined bodies, or of hulls and boxes. */
VERICONE_API vericone_body* vericone_body_union(const vericone_body* const* bodies, size_t count);
VERICONE_API void vericone_body_free(vericone_body* body);

/* enum vericone_kind */
VERICONE_API int32_t vericone_body_kind(const vericone_body* body);
/* Around the body, in its own axes. */
VERICONE_API int32_t vericone_body_bounds(const vericone_body* body, double low[3], double high[3]);
/* max n.x over the body, rounded; NaN after an error. */
VERICONE_API double vericone_body_support(const vericone_body* body, const double n[3]);
/* An ellipsoid that contains the body: its centre, and the matrix S, row by row, of (x - c)^T S^-1 (x - c)
 * <= 1. */
VERICONE_API int32_t vericone_body_containing_ellipsoid(const vericone_body* body, double center[3],
                                                        double shape[9]);

/* All that defines the body, for another process or machine with a library of this version: how many numbers;
 * the first `capacity` of them are written. */
VERICONE_API int64_t vericone_body_numbers(const vericone_body* body, double* numbers, size_t capacity);
/* The same body again, bit for bit: one of any kind. */
VERICONE_API vericone_body* vericone_body_of_numbers(const double* numbers, size_t count);

/* ---- Pairs ---- */

typedef struct vericone_pair vericone_pair;

/* The answers of vericone_pair_verdict: 0, and nothing else, lets a body fly on, an error neither. */
enum vericone_verdict {
  VERICONE_OUT,      /* they never meet */
  VERICONE_ON,       /* they will touch without overlapping */
  VERICONE_IN,       /* they will overlap */
  VERICONE_TOUCHING, /* they touch now */
  VERICONE_OVERLAPPING /* they overlap now */,
  VERICONE_UNDECIDED /* one of the others; never of pairs that are exact */
};
enum vericone_relation { VERICONE_DISJOINT, VERICONE_TOUCHES, VERICONE_OVERLAPS, VERICONE_RELATION_UNKNOWN };

/* Two bodies of any kinds where they stand, prepared for many velocities (two ellipsoids: 0.5 us).
 * `tolerance`: of pairs that are certified and not exact, the part of a body's size below which features may
 * stay undecided; 0: what suits the pair (1e-6 or 1e-3). Velocities below are those of agent and obstacle in
 * the world; nothing turns. */
VERICONE_API vericone_pair* vericone_pair_new(const vericone_body* agent, const double agent_position[3],
                                              const double agent_rotation[9], const vericone_body* obstacle,
                                              const double obstacle_position[3],
                                              const double obstacle_rotation[9], double tolerance);
VERICONE_API void vericone_pair_free(vericone_pair* pair);

/* 1: every verdict is right and none undecided. 0: verdicts are right or undecided. */
VERICONE_API int32_t vericone_pair_exact(const vericone_pair* pair);
/* Now; enum vericone_relation. */
VERICONE_API int32_t vericone_pair_relation(const vericone_pair* pair);
/* enum vericone_verdict. No allocation; two ellipsoids 20 to 40 ns. */
VERICONE_API int32_t vericone_pair_verdict(const vericone_pair* pair, const double agent_velocity[3],
                                           const double obstacle_velocity[3]);
/* What decided the verdict of an exact pair: doubles with a bound of their error, intervals, whole numbers.
 */
enum vericone_rung { VERICONE_TRIAGE, VERICONE_INTERVAL, VERICONE_EXACT, VERICONE_CERTIFIED };
/* enum vericone_rung; of pairs that are not exact VERICONE_CERTIFIED. For measurements. */
VERICONE_API int32_t vericone_pair_rung(const vericone_pair* pair, const double agent_velocity[3],
                                        const double obstacle_velocity[3]);
/* Whether they meet from `from` until `until`, seconds >= 0; INFINITY: for ever. As Pair::verdict() within a
 * horizon: `in` where they overlap by its end, `on` where they only touch by then. */
VERICONE_API int32_t vericone_pair_verdict_within(const vericone_pair* pair, const double agent_velocity[3],
                                                  const double obstacle_velocity[3], double from,
                                                  double until);
/* Of many velocities of the agent, xyz by xyz, a byte each. Returns how many of them may collide: are not
 * out. */
VERICONE_API int64_t vericone_pair_verdicts(const vericone_pair* pair, const double* agent_velocities,
                                            size_t count, const double obstacle_velocity[3],
                                            uint8_t* verdicts);

/* What proves the verdict within that time, for programs that check it and know nothing of this library
 * (docs/reference/certificates.md): one JSON object on one line. Its first bytes, at most `capacity` - 1, and
 * a 0 go to `text`. Returns its length, of which `capacity` must be more for all of it (two ellipsoids: 1 kB,
 * a mesh some 40 bytes a triangle); 0: there is none, and `text` says why. Two ellipsoids 10 us, a mesh of
 * 5,000 triangles 3 ms. */
VERICONE_API int64_t vericone_pair_certificate(const vericone_pair* pair, const double agent_velocity[3],
                                               const double obstacle_velocity[3], double from, double until,
                                               char* text, size_t capacity);

typedef struct vericone_contact {
  double earliest, latest; /* s from now; proved: nothing is touched before `earliest`; they have touched by
                              `latest`, where vericone_pair_verdict() is not undecided */
  double time;             /* s, the best estimate; NaN where there is none */
  double point[3];  /* of the obstacle, rounded, in the world at that time; NaN where it is not known */
  double normal[3]; /* unit, from the agent towards the obstacle; NaN where it is not known */
} vericone_contact;
/* 1: `contact` is the first one; 0: they never meet. */
VERICONE_API int32_t vericone_pair_contact(const vericone_pair* pair, const double agent_velocity[3],
                                           const double obstacle_velocity[3], vericone_contact* contact);

typedef struct vericone_miss {
  double least, most; /* the least distance from now on lies between, proved; both 0 where they meet */
  double depth; /* where they meet: how far along -normal the agent must be shifted, at least, to avoid it */
  double normal[3]; /* unit, from the agent towards the obstacle where they are nearest; zero where there is
                       none */
  double time;      /* s, when they are nearest */
  double distance;  /* the best estimate, -depth where they meet */
} vericone_miss;
VERICONE_API int32_t vericone_pair_miss(const vericone_pair* pair, const double agent_velocity[3],
                                        const double obstacle_velocity[3], vericone_miss* miss);

/* h: the least distance from now until `until` (s, 0 or more, INFINITY: for ever) while both go straight on;
 * where they meet, minus the way by which one would have to be shifted. A row for optimisers. */
typedef struct vericone_barrier {
  double h;              /* m, the best estimate */
  double least;          /* m: h is no less, proved */
  double by_position[3]; /* derivatives of h, to the agent's position; to the obstacle's, the opposite */
  double by_velocity[3]; /* s, to the agent's velocity; to the obstacle's, the opposite */
  double by_rotation[3]; /* m/rad, to a small rotation of the agent about its position */
  double time;           /* s, when they are nearest */
} vericone_barrier;
VERICONE_API int32_t vericone_pair_barrier(const vericone_pair* pair, const double agent_velocity[3],
                                           const double obstacle_velocity[3], double until,
                                           vericone_barrier* barrier);

/* The least sector that holds the colliding directions on the plane through the line of sight and `across`.
 */
typedef struct vericone_sector {
  double line_of_sight[3], across[3]; /* unit, orthogonal; angles are from the first towards the second */
  double distance;                    /* between the middles of the bodies */
  double left, right;                 /* the sector is from -right to left */
  double left_error,
      right_error; /* beyond left + left_error nothing collides, proved; 0: right to rounding */
} vericone_sector;
/* 1: `sector` is it; 0: the bodies are not apart, or no direction of the plane collides. */
VERICONE_API int32_t vericone_pair_sector(const vericone_pair* pair, const double across[3],
                                          vericone_sector* sector);

/* ---- Cones ---- */

typedef struct vericone_cone vericone_cone;

/* All colliding directions of v_agent - v_obstacle, between an inner cone and an outer one, both proved.
 * `tolerance`: by what part of the outer solid angle they may differ, 1e-9 to 1, 0: 0.01; `resolution`: of
 * cones that are drawn as a map of the sphere (meshes, clouds, unions), 0: 0.01. Two ellipsoids 40 us, a map
 * seconds. */
VERICONE_API vericone_cone* vericone_cone_new(const vericone_pair* pair, double tolerance, double resolution,
                                              int32_t threads);
VERICONE_API void vericone_cone_free(vericone_cone* cone);
/* 0: outside of the outer cone; 1: in the inner one; 2: between them. */
VERICONE_API int32_t vericone_cone_contains(const vericone_cone* cone, const double w[3]);
/* Steradian: the true one lies between. */
VERICONE_API int32_t vericone_cone_solid_angle(const vericone_cone* cone, double* least, double* most);
/* Loops of directions around the inner cone (which = 0) or the outer one (1), the cone to their left: how
 * many there are. */
VERICONE_API int64_t vericone_cone_loops(const vericone_cone* cone, int32_t which);
/* How many directions loop `index` has; the first `capacity` of them are written, unit vectors xyz by xyz. */
VERICONE_API int64_t vericone_cone_loop(const vericone_cone* cone, int32_t which, size_t index,
                                        double* directions, size_t capacity);

/* ---- Navigator ---- */

typedef struct vericone_navigator vericone_navigator;

/* A body that stands somewhere and moves. All zero: `rotation` not turned, `omega` does not turn. */
typedef struct vericone_moving {
  const vericone_body* body;
  double position[3], rotation[9];
  double velocity[3]; /* m/s */
  double omega[3];    /* rad/s */
} vericone_moving;

enum vericone_navigator_status {
  VERICONE_STRAIGHT,     /* nothing to avoid, nowhere to go */
  VERICONE_HOMING,       /* goes to its destination, or points at it */
  VERICONE_AVOIDING,     /* on a course beside the one that it wants */
  VERICONE_TOO_NEAR,     /* every course tried comes nearer to a body than required, this one least */
  VERICONE_CANNOT_AVOID, /* every course tried hits a body, this one last */
  VERICONE_NO_COURSE     /* at rest, and must not change its speed; nothing hits it */
};

typedef struct vericone_command {
  double acceleration[3]; /* m/s^2, to be held for the step */
  double least; /* of the course flown: metres to what it comes nearest to; negative where it hits; infinite
                   alone */
  int64_t nearest; /* the index of that body */
  int32_t status;  /* enum vericone_navigator_status */
  int32_t aligned; /* 1: points at the destination */
} vericone_command;

/* `required`: metres to keep from every body; NaN: a twentieth of the agent's half-length. `acceleration`:
 * m/s^2 that it has, across its velocity, where it may change its speed (`longitudinal` not 0) in all
 * directions; may be infinite. */
VERICONE_API vericone_navigator* vericone_navigator_new(double required, double acceleration,
                                                        int32_t longitudinal);
VERICONE_API void vericone_navigator_free(vericone_navigator* navigator);
/* The command at `time`, held for `step` seconds; returns its status. `destination`: NULL for none;
 * `destination_acceleration`: m/s^2 with which it turns towards it. The body of one that turns is judged by
 * the ball about it. No allocation once it has searched among as many bodies. One thread at a time. 2 to 10
 * us an ellipsoid where the course is kept, some milliseconds where one is looked for. */
VERICONE_API int32_t vericone_navigator_step(vericone_navigator* navigator, const vericone_moving* agent,
                                             const vericone_moving* others, size_t count,
                                             const double destination[3], double destination_acceleration,
                                             double time, double step, vericone_command* command);

/* ---- Bands and the nearest safe velocity ---- */

typedef struct vericone_range {
  double from, to;
} vericone_range;

typedef struct vericone_band_options {
  double from, until;                     /* s, contacts at other times do not count; INFINITY: for ever */
  double margin;                          /* m to keep from every body */
  double wind[3];                         /* m/s, added to the agent's velocity through the air */
  double speed[2], climb[2];              /* m/s, what is asked about; both 0: about the agent's own */
  double altitude[2];                     /* m above where it is; both 0: not asked */
  double lateral, longitudinal, vertical; /* m/s^2 with which it changes its velocity; 0: at once */
  int32_t last;                           /* not 0: vericone_band.last is looked for */
} vericone_band_options;
/* From now on for ever, no margin, no wind, at once. */
VERICONE_API int32_t vericone_band_defaults(vericone_band_options* options);

/* One quantity changed: headings in rad clockwise from y, speeds and climb rates in m/s, altitudes in m. The
 * first ranges, in order, are written to arrays of the caller's; the counts say how many there are. */
typedef struct vericone_band {
  vericone_range* free; /* every value keeps the margin from all, proved */
  size_t free_capacity;
  vericone_range* conflict; /* no value does, proved; what is in neither is not known */
  size_t conflict_capacity;
  size_t free_count, conflict_count; /* written */
  double last; /* written: s for which the agent may go on and still have a free value; negative: it has none
                  now; INFINITY: its course is free; NaN: not asked */
} vericone_band;

typedef struct vericone_course {
  double time_to_violation; /* s until the margin is lost on the present course, at least; INFINITY: kept */
  double recovery_heading, recovery_time; /* where nothing is free: the heading (rad) that is out soonest, and
                                             when (s); NaN: none */
} vericone_course;

/* Which headings, speeds, climb rates and altitudes keep an agent apart from all others, which keep their
 * velocities. Bands and `course` may be NULL. 0: the present course keeps the margin; 1: it does not, or that
 * is not known. Nothing may turn: `omega` is 0. Ellipsoids 10 us each. */
VERICONE_API int32_t vericone_bands(const vericone_moving* agent, const vericone_moving* others, size_t count,
                                    const vericone_band_options* options, vericone_band* heading,
                                    vericone_band* speed, vericone_band* climb, vericone_band* altitude,
                                    vericone_course* course);

typedef struct vericone_avoid_options {
  double until;                 /* s: contacts later than that do not count */
  double margin;                /* m to keep from every body */
  double wind[3];               /* m/s, added to the agent's velocity through the air */
  double speed[2], climb[2];    /* m/s, least and most of what the agent can fly */
  double lateral, longitudinal; /* m/s^2 with which it changes its velocity; both 0: at once */
  double gap;                   /* between `lower` and `distance`, relative, at which the search ends */
  size_t most;                  /* rays that are looked along */
} vericone_avoid_options;
/* 60 s, no margin, no wind, any speed and climb, at once, 0.01, 2000. */
VERICONE_API int32_t vericone_avoid_defaults(vericone_avoid_options* options);

enum vericone_avoid_status {
  VERICONE_FREE,         /* the velocity keeps the margin until then, proved */
  VERICONE_NOTHING_SAFE, /* none that can be flown does, proved */
  VERICONE_NOT_FOUND     /* none was found */
};

typedef struct vericone_avoidance {
  double velocity[3];        /* m/s, through the air */
  double distance, lower;    /* m/s from the wanted one; no safe velocity is nearer than `lower`, proved */
  double safe_until, latest; /* s: the velocity keeps the margin until the first, none does until the second,
                                proved; INFINITY: not known */
  double first_time;         /* s: where it is not free, when it meets a body first; NaN: never */
  int64_t first;             /* the index of that body, or -1 */
} vericone_avoidance;

/* The safe velocity that is nearest to the wanted one; enum vericone_avoid_status. Nothing may turn: `omega`
 * is 0. Some microseconds where the wanted velocity is safe, a millisecond where it is not. */
VERICONE_API int32_t vericone_avoid(const vericone_moving* agent, const double wanted[3],
                                    const vericone_moving* others, size_t count,
                                    const vericone_avoid_options* options, vericone_avoidance* found);

#ifdef __cplusplus
}
#endif

#endif
