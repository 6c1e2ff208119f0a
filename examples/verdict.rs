// SPDX-License-Identifier: BSD-3-Clause
//
// Verdicts from Rust, by declaration: rustc verdict.rs -L PREFIX/lib
use std::ffi::{c_char, c_void, CStr};
use std::ptr::null;

#[link(name = "vericone_c")]
extern "C" {
    fn vericone_body_ellipsoid(center: *const f64, semi_axes: *const f64, rotation: *const f64) -> *mut c_void;
    fn vericone_body_free(body: *mut c_void);
    fn vericone_pair_new(
        agent: *const c_void, agent_position: *const f64, agent_rotation: *const f64,
        obstacle: *const c_void, obstacle_position: *const f64, obstacle_rotation: *const f64, tolerance: f64,
    ) -> *mut c_void;
    fn vericone_pair_free(pair: *mut c_void);
    fn vericone_pair_verdict(pair: *const c_void, agent_velocity: *const f64, obstacle_velocity: *const f64) -> i32;
    fn vericone_error() -> *const c_char;
}

fn main() {
    let origin = [0.0; 3];
    unsafe {
        let ball = vericone_body_ellipsoid(origin.as_ptr(), [1.0; 3].as_ptr(), null());
        let pair = vericone_pair_new(ball, origin.as_ptr(), null(), ball, [0.0, 4.0, 0.0].as_ptr(), null(), 0.0);
        for velocity in [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0]] {
            let verdict = vericone_pair_verdict(pair, velocity.as_ptr(), origin.as_ptr());
            let why = if verdict < 0 { CStr::from_ptr(vericone_error()).to_str().unwrap() } else { "" };
            println!("{verdict} {why}");
        }
        vericone_pair_free(pair);
        vericone_body_free(ball);
    }
}
