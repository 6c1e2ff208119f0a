(* Vectors and matrices of three, over the reals: what the statements and their proofs calculate with. *)
Require Export Reals Lra Psatz List QArith Qreals.
Export ListNotations.
Open Scope R_scope.

Record vec (T : Type) := Vec { vx : T; vy : T; vz : T }.
Arguments Vec {T}. Arguments vx {T}. Arguments vy {T}. Arguments vz {T}.
Record mat (T : Type) := Rows { r1 : vec T; r2 : vec T; r3 : vec T }.
Arguments Rows {T}. Arguments r1 {T}. Arguments r2 {T}. Arguments r3 {T}.

Definition zero : vec R := Vec 0 0 0.
Definition add (a b : vec R) := Vec (vx a + vx b) (vy a + vy b) (vz a + vz b).
Definition sub (a b : vec R) := Vec (vx a - vx b) (vy a - vy b) (vz a - vz b).
Definition opp (a : vec R) := Vec (- vx a) (- vy a) (- vz a).
Definition scale (k : R) (a : vec R) := Vec (k * vx a) (k * vy a) (k * vz a).
Definition dot (a b : vec R) := vx a * vx b + vy a * vy b + vz a * vz b.
Definition cross (a b : vec R) :=
  Vec (vy a * vz b - vz a * vy b) (vz a * vx b - vx a * vz b) (vx a * vy b - vy a * vx b).
Definition mul (M : mat R) (u : vec R) := Vec (dot (r1 M) u) (dot (r2 M) u) (dot (r3 M) u).
Definition turn (M : mat R) := (* the transpose *)
  Rows (Vec (vx (r1 M)) (vx (r2 M)) (vx (r3 M)))
       (Vec (vy (r1 M)) (vy (r2 M)) (vy (r3 M)))
       (Vec (vz (r1 M)) (vz (r2 M)) (vz (r3 M))).
Definition det (M : mat R) := dot (r1 M) (cross (r2 M) (r3 M)).
Definition adj (M : mat R) := (* M (adj M) = (adj M) M = det M *)
  turn (Rows (cross (r2 M) (r3 M)) (cross (r3 M) (r1 M)) (cross (r1 M) (r2 M))).
Definition form (M : mat R) (u : vec R) := dot u (mul M u). (* u^T M u *)

Ltac open_vec := repeat match goal with
  | v : vec _ |- _ => destruct v
  | M : mat _ |- _ => destruct M
  end.
Ltac plain := unfold form, adj, det, turn, mul, cross, dot, scale, opp, sub, add, zero in *;
  cbn [vx vy vz r1 r2 r3] in *.
Ltac parts := match goal with |- Vec _ _ _ = Vec _ _ _ => f_equal | _ => idtac end.
Ltac veq := intros; open_vec; plain; parts; ring.

Lemma dot_add : forall n a b, dot n (add a b) = dot n a + dot n b. Proof. veq. Qed.
Lemma dot_sub : forall n a b, dot n (sub a b) = dot n a - dot n b. Proof. veq. Qed.
Lemma dot_scale : forall n k a, dot n (scale k a) = k * dot n a. Proof. veq. Qed.
Lemma dot_opp : forall n a, dot (opp n) a = - dot n a. Proof. veq. Qed.
Lemma dot_opp_r : forall n a, dot n (opp a) = - dot n a. Proof. veq. Qed.
Lemma dot_sym : forall a b, dot a b = dot b a. Proof. veq. Qed.
Lemma mul_scale : forall M k u, mul M (scale k u) = scale k (mul M u). Proof. veq. Qed.
Lemma dot_mul : forall n M u, dot n (mul M u) = dot (mul (turn M) n) u. Proof. veq. Qed.

Lemma dot_self : forall a, 0 <= dot a a.
Proof. intros; open_vec; plain; nra. Qed.

Lemma square_pos : forall x, 0 <= x * x.
Proof. intros; nra. Qed.
Lemma square_le : forall x y, 0 <= y -> x * x <= y * y -> x <= y.
Proof. intros; nra. Qed.
Lemma square_lt : forall x y, 0 <= y -> x * x < y * y -> x < y.
Proof. intros; nra. Qed.

(* Cauchy-Schwarz by Lagrange's identity. *)
Lemma cauchy : forall a b, dot a b * dot a b <= dot a a * dot b b.
Proof.
  intros a b.
  assert (E : dot a a * dot b b - dot a b * dot a b = dot (cross a b) (cross a b)) by veq.
  pose proof (dot_self (cross a b)). lra.
Qed.

Lemma dot_self_zero : forall a, dot a a <= 0 -> a = zero.
Proof. intros a H. open_vec; plain. f_equal; nra. Qed.

Lemma mul_adj : forall M d, mul M (mul (adj M) d) = scale (det M) d.
Proof. veq. Qed.
