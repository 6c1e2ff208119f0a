(* What is claimed: bodies as sets of points, their motion as a function of time, collisions.
   A reader who trusts this file, Coq and the printed statement need read no other proof. *)
From Vericone Require Export Space.
Open Scope R_scope.

(* Bodies are given by numbers of any type T: rationals in a certificate, reals in what it means. *)
Inductive convex (T : Type) :=
  | Ellipsoid (p : vec T) (F : mat T)     (* p + F u, |u| <= 1 *)
  | Shaped (p : vec T) (M : mat T)        (* (n.(x - p))^2 <= n^T M n for all n *)
  | Ball (p : vec T) (r : T)
  | Box (lo hi : vec T)                   (* along the axes *)
  | Hull (points : list (vec T))
  | Cut (c : convex T) (p : vec T) (A : mat T) (l : T).   (* what has (x - p)^T A (x - p) <= l of c *)
Arguments Ellipsoid {T}. Arguments Shaped {T}. Arguments Ball {T}. Arguments Box {T}. Arguments Hull {T}.
Arguments Cut {T}.

(* The sum of weights times points. *)
Fixpoint mean (ws : list R) (ps : list (vec R)) : vec R :=
  match ws, ps with w :: ws, p :: ps => add (scale w p) (mean ws ps) | _, _ => zero end.
Definition total (ws : list R) := fold_right Rplus 0 ws.

Fixpoint inside (c : convex R) (x : vec R) : Prop :=
  match c with
  | Ellipsoid p F => exists u, dot u u <= 1 /\ x = add p (mul F u)
  | Shaped p M => forall n, dot n (sub x p) * dot n (sub x p) <= form M n
  | Ball p r => 0 <= r /\ dot (sub x p) (sub x p) <= r * r
  | Box lo hi => vx lo <= vx x <= vx hi /\ vy lo <= vy x <= vy hi /\ vz lo <= vz x <= vz hi
  | Hull ps => exists ws, length ws = length ps /\ Forall (fun w => 0 <= w) ws /\ total ws = 1 /\
      x = mean ws ps
  | Cut c p A l => inside c x /\ form A (sub x p) <= l
  end.

(* A body is the union of its pieces. *)
Definition body (T : Type) := list (convex T).
Definition within_body (b : body R) (x : vec R) : Prop := exists c, In c b /\ inside c x.

(* A piece, a body that moves with velocity v, at time t. *)
Definition inside_at (c : convex R) (v : vec R) (t : R) (x : vec R) : Prop := inside c (sub x (scale t v)).
Definition there (b : body R) (v : vec R) (t : R) (x : vec R) : Prop := within_body b (sub x (scale t v)).

(* The times from the first to the second, or for ever. *)
Record horizon (T : Type) := Horizon { from : T; until : option T }.
Arguments Horizon {T}. Arguments from {T}. Arguments until {T}.
Definition in_time (h : horizon R) (t : R) : Prop :=
  from h <= t /\ match until h with None => True | Some T => t <= T end.

(* Two bodies and their motions. *)
Record case (T : Type) := Case
  { agent : body T; obstacle : body T; vA : vec T; vB : vec T; when : horizon T }.
Arguments Case {T}. Arguments agent {T}. Arguments obstacle {T}.
Arguments vA {T}. Arguments vB {T}. Arguments when {T}.

(* Any two of their points are farther apart than d, at all times. With d = 0: they have no common point. *)
Definition out (d : R) (k : case R) : Prop :=
  forall t x y, in_time (when k) t -> there (agent k) (vA k) t x -> there (obstacle k) (vB k) t y ->
  d * d < dot (sub x y) (sub x y).

(* No longer than e. *)
Definition near (e : R) (d : vec R) : Prop := dot d d <= e * e.

(* They meet, and do so from all places of A near by and with all velocities near its own. *)
Definition in_cone (k : case R) : Prop :=
  exists e, 0 < e /\ forall h d, near e h -> near e d ->
  exists t x, in_time (when k) t /\ there (agent k) (add (vA k) d) t (sub x h) /\
    there (obstacle k) (vB k) t x.

(* They meet; and of any two pieces either they never do, or one of them, moved by however little of some n, never
   does. *)
Definition on_cone (k : case R) : Prop :=
  (exists t x, in_time (when k) t /\ there (agent k) (vA k) t x /\ there (obstacle k) (vB k) t x) /\
  forall a b, In a (agent k) -> In b (obstacle k) ->
    (forall t x, in_time (when k) t -> inside_at a (vA k) t x -> ~ inside_at b (vB k) t x) \/
    exists n, forall e t x, 0 < e -> in_time (when k) t ->
      inside_at a (vA k) t (add x (scale e n)) -> ~ inside_at b (vB k) t x.
