(* Quadratic forms that are positive definite: what proves two round bodies apart where no plane does, in dents. *)
From Vericone Require Export Rational.
Open Scope Q_scope.

(* Linear functions of a list of reals; what is left out is 0. *)
Definition linear := list Q.
Fixpoint at_point (a : linear) (z : list R) : R :=
  match a, z with x :: a, y :: z => (Q2R x * y + at_point a z)%R | _, _ => 0%R end.
Fixpoint sum_linear (a b : linear) : linear :=
  match a, b with [], b => b | a, [] => a | x :: a, y :: b => reduced (x + y) :: sum_linear a b end.
Definition times_linear (k : Q) (a : linear) : linear := map (fun x => reduced (k * x)) a.

Lemma sum_linear_at : forall a b z, at_point (sum_linear a b) z = (at_point a z + at_point b z)%R.
Proof.
  induction a as [|x a IH]; intros [|y b] [|u z]; cbn; try ring. rewrite IH, reduced_value, Q2R_plus. ring.
Qed.
Lemma times_linear_at : forall k a z, at_point (times_linear k a) z = (Q2R k * at_point a z)%R.
Proof.
  intros k; induction a as [|x a IH]; intros [|u z]; cbn; try ring. unfold times_linear in IH.
  rewrite IH, reduced_value, Q2R_mult. ring.
Qed.

(* A symmetric matrix by its diagonal and what stands right of it. *)
Definition triangle := list (Q * linear).
Fixpoint quadratic (U : triangle) (z : list R) : R :=
  match U, z with
  | (d, r) :: U, x :: z => (Q2R d * (x * x) + 2 * x * at_point r z + quadratic U z)%R
  | _, _ => 0%R
  end.
(* U + k a b *)
Fixpoint add_product (k : Q) (a b : linear) (U : triangle) : triangle :=
  match U, a, b with
  | (d, r) :: U, x :: a, y :: b =>
      (reduced (d + k * (x * y)),
       sum_linear r (times_linear (k * (1 # 2)) (sum_linear (times_linear x b) (times_linear y a)))) :: add_product k a b U
  | _, _, _ => U
  end.

Lemma add_product_length : forall U k a b, length (add_product k a b U) = length U.
Proof. induction U as [|[d r] U IH]; intros k [|x a] [|y b]; try reflexivity. cbn. rewrite IH. reflexivity. Qed.
Lemma add_product_value : forall U k a b z, length z = length U ->
  quadratic (add_product k a b U) z = (quadratic U z + Q2R k * (at_point a z * at_point b z))%R.
Proof.
  induction U as [|[d r] U IH]; intros k a b [|u z] L; try discriminate L.
  - destruct a, b; cbn; ring.
  - destruct a as [|x a]; [cbn; ring|]. destruct b as [|y b]; [cbn; ring|].
    cbn [add_product quadratic at_point]. rewrite IH by (injection L; auto).
    rewrite sum_linear_at, times_linear_at, sum_linear_at, !times_linear_at, reduced_value, Q2R_plus, !Q2R_mult.
    replace (Q2R (1 # 2)) with (1 / 2)%R by (unfold Q2R; cbn; lra). field.
Qed.

(* All pivots of the elimination are above 0. *)
Fixpoint definite (n : nat) (U : triangle) : bool :=
  match n, U with
  | S n, (d, r) :: U => lt 0 d && definite n (add_product (- (/ d)) r r U)
  | _, [] => true
  | _, _ => false
  end.
Lemma definite_real : forall n U, definite n U = true -> forall z, length z = length U ->
  (0 <= quadratic U z)%R /\ ((quadratic U z <= 0)%R -> Forall (fun x => x = 0%R) z).
Proof.
  induction n as [|n IH]; intros [|[d r] U] H [|x z] L; try discriminate H; try discriminate L;
    try (cbn; split; [lra|constructor]).
  cbn [definite] in H. apply andb_prop in H. destruct H as [D H]. apply lt_real in D. rewrite Q2R_zero in D.
  assert (Lz : length z = length U) by (injection L; auto).
  destruct (IH _ H z ltac:(rewrite add_product_length; exact Lz)) as [P Z].
  rewrite add_product_value, Q2R_opp, Q2R_inv in P, Z by (try assumption; intros E; apply Qeq_eqR in E; rewrite Q2R_zero in E; lra).
  cbn [quadratic]. set (q := at_point r z) in *. set (e := Q2R d) in *.
  assert (E : (e * (x * x) + 2 * x * q + quadratic U z
    = e * ((x + q / e) * (x + q / e)) + (quadratic U z + - / e * (q * q)))%R) by (field; lra).
  assert (S0 : (0 <= e * ((x + q / e) * (x + q / e)))%R) by (apply Rmult_le_pos; [lra|apply square_pos]).
  rewrite E. split; [lra|]. intros N. assert (F := Z ltac:(lra)).
  assert (Q0 : q = 0%R).
  { unfold q. clear - F. revert r. induction z as [|y z IH]; intros [|c r]; try reflexivity. inversion F; subst. cbn.
    rewrite IH by assumption. ring. }
  constructor; [|exact F]. rewrite Q0 in *.
  assert (X : (e * (x * x) <= 0)%R).
  { replace (x + 0 / e)%R with x in * by (field; lra). lra. }
  assert (x * x <= 0)%R by nra. nra.
Qed.

(* Sums of products of linear functions. *)
Definition terms := list (Q * linear * linear).
Fixpoint terms_at (ts : terms) (z : list R) : R :=
  match ts with [] => 0%R | (k, a, b) :: ts => (Q2R k * (at_point a z * at_point b z) + terms_at ts z)%R end.
Definition matrix_of (n : nat) (ts : terms) : triangle :=
  fold_right (fun t U => add_product (fst (fst t)) (snd (fst t)) (snd t) U) (repeat (0, []) n) ts.
Lemma matrix_of_length : forall n ts, length (matrix_of n ts) = n.
Proof.
  induction ts as [|[[k a] b] ts IH]; cbn; [apply repeat_length|]. rewrite add_product_length. exact IH.
Qed.
Lemma matrix_of_value : forall n ts z, length z = n -> quadratic (matrix_of n ts) z = terms_at ts z.
Proof.
  induction ts as [|[[k a] b] ts IH]; intros z L.
  - cbn. revert z L. induction n as [|n IH]; intros [|x z] L; try discriminate L; [reflexivity|].
    cbn. rewrite IH by (injection L; auto). rewrite Q2R_zero. ring.
  - cbn [matrix_of fold_right terms_at fst snd]. fold (matrix_of n ts).
    rewrite add_product_value by (rewrite matrix_of_length; exact L). rewrite IH by exact L. ring.
Qed.

(* Where the first coordinate is 1, terms of a definite matrix are above 0. *)
Lemma terms_positive : forall n ts z, definite n (matrix_of n ts) = true -> length (1%R :: z) = n -> (0 < terms_at ts (1%R :: z))%R.
Proof.
  intros n ts z H L. destruct (definite_real _ _ H (1%R :: z)) as [P Z]; [rewrite matrix_of_length; exact L|].
  rewrite matrix_of_value in P, Z by exact L.
  destruct (Rle_dec (terms_at ts (1%R :: z)) 0) as [N|N]; [|lra]. specialize (Z N). inversion Z; lra.
Qed.

Definition scaled_terms (m : Q) (ts : terms) : terms := map (fun t => (reduced (m * fst (fst t)), snd (fst t), snd t)) ts.
Lemma scaled_terms_at : forall m ts z, terms_at (scaled_terms m ts) z = (Q2R m * terms_at ts z)%R.
Proof.
  induction ts as [|[[k a] b] ts IH]; intros z; cbn; [ring|]. unfold scaled_terms in IH. rewrite IH, reduced_value, Q2R_mult. ring.
Qed.
Lemma app_terms_at : forall ts us z, terms_at (ts ++ us) z = (terms_at ts z + terms_at us z)%R.
Proof. induction ts as [|[[k a] b] ts IH]; intros us z; cbn; [ring|]. rewrite IH. ring. Qed.

(* (1, y, t), y = x - t v_B. a.(y - p - t u) as such a function: *)
Definition moment (y : vec R) (t : R) : list R := [1%R; vx y; vy y; vz y; t].
Definition along (a p u : vec Q) : linear := [- dotq a p; vx a; vy a; vz a; - dotq a u].
Lemma along_at : forall a p u y t, at_point (along a p u) (moment y t) = dot (rv a) (sub (sub y (rv p)) (scale t (rv u))).
Proof. intros. unfold along, moment. cbn [at_point]. rewrite !Q2R_opp, !Q2R_dot. unfold dot, sub, scale, rv. cbn [vx vy vz]. ring. Qed.
Definition constant (c : Q) : linear := [c].
Lemma constant_at : forall c y t, at_point (constant c) (moment y t) = Q2R c.
Proof. intros. unfold constant, moment. cbn. ring. Qed.

(* d^T A d - level, d = y - p - t u *)
Definition form_of (A : mat Q) (p u : vec Q) (k level : Q) : terms :=
  [(k, along (Vec 1 0 0) p u, along (r1 A) p u); (k, along (Vec 0 1 0) p u, along (r2 A) p u);
   (k, along (Vec 0 0 1) p u, along (r3 A) p u); (- level, constant 1, constant 1)].
Lemma form_of_at : forall A p u k level y t,
  terms_at (form_of A p u k level) (moment y t)
  = (Q2R k * form (rm A) (sub (sub y (rv p)) (scale t (rv u))) - Q2R level)%R.
Proof.
  intros. unfold form_of. cbn [terms_at]. rewrite !along_at, !constant_at, Q2R_opp, Q2R_one.
  set (d := sub (sub y (rv p)) (scale t (rv u))). unfold form, mul, rm. cbn [r1 r2 r3].
  assert (E : forall a b c, dot (rv (Vec a b c)) d = (Q2R a * vx d + Q2R b * vy d + Q2R c * vz d)%R) by reflexivity.
  rewrite !E, Q2R_one, Q2R_zero. generalize (dot (rv (r1 A)) d) (dot (rv (r2 A)) d) (dot (rv (r3 A)) d). intros a b c.
  unfold dot. cbn [vx vy vz]. ring.
Qed.

Definition gramq (A : mat Q) := let B := turnq A in Rows (mulq B (r1 B)) (mulq B (r2 B)) (mulq B (r3 B)).
Lemma rm_gram : forall A, rm (gramq A) = gram (rm A).
Proof. intros. unfold gramq, gram, rm at 1. cbn [r1 r2 r3]. cbv zeta. rewrite !rv_mul. reflexivity. Qed.
Definition unitq : mat Q := Rows (Vec 1 0 0) (Vec 0 1 0) (Vec 0 0 1).
Lemma rm_unit : rm unitq = unit_shape.
Proof. unfold unitq, unit_shape, rm, rv. cbn [r1 r2 r3 vx vy vz]. rewrite Q2R_one, Q2R_zero. reflexivity. Qed.

(* What is not above 0 at the points of a body that moves with u; none of a body of corners. *)
Fixpoint forms_of (c : convex Q) (u : vec Q) : option (list terms) :=
  match c with
  | Ellipsoid p F => if eq (detq F) 0 then None
      else Some [form_of (gramq (adjq F)) p u (reduced (/ (detq F * detq F))) 1]
  | Shaped p M => if positive_shapeq M then Some [form_of (adjq M) p u (reduced (/ detq M)) 1] else None
  | Ball p r => Some [form_of unitq p u 1 (r * r)]
  | Cut c p A l => match forms_of c u with Some fs => Some (fs ++ [form_of A p u 1 l]) | None => None end
  | Box _ _ | Hull _ => Some []
  end.
Lemma inverse_below : forall k f, (0 < k)%R -> (f <= k)%R -> (/ k * f <= 1)%R.
Proof. intros k f K F. apply (Rmult_le_reg_l k); [exact K|]. rewrite <- Rmult_assoc, Rinv_r by lra. lra. Qed.
Lemma shape_below : forall p M x, positive_shape M -> inside (Shaped p M) x -> (form (adj M) (sub x p) <= det M)%R.
Proof.
  intros p M x P I. set (d := sub x p). specialize (I (mul (adj M) d)). fold d in I.
  assert (Q : form M (mul (adj M) d) = (det M * form (adj M) d)%R).
  { unfold form at 1. rewrite mul_adj, dot_scale. unfold form. rewrite dot_sym. reflexivity. }
  rewrite Q in I. replace (dot (mul (adj M) d) d) with (form (adj M) d) in I by (unfold form; apply dot_sym).
  assert (D : (0 < det M)%R) by apply P. set (f := form (adj M) d) in *.
  destruct (Rle_dec f (det M)); [assumption|]. nra.
Qed.
Lemma ellipsoid_below : forall p F x, inside (Ellipsoid p F) x -> (form (gram (adj F)) (sub x p) <= det F * det F)%R.
Proof.
  intros p F x (w & W & ->). rewrite gram_form.
  replace (mul (adj F) (sub (add p (mul F w)) p)) with (scale (det F) w) by (clear W; veq).
  replace (dot (scale (det F) w) (scale (det F) w)) with (det F * det F * dot w w)%R by (generalize (det F); clear; veq).
  pose proof (square_pos (det F)). nra.
Qed.
Lemma forms_of_real : forall c u fs y t, forms_of c u = Some fs -> inside (rc c) (sub y (scale t (rv u))) ->
  Forall (fun f => (terms_at f (moment y t) <= 0)%R) fs.
Proof.
  induction c as [p F|p M|p r|lo hi|ps|c IH p A l]; intros u fs y t H I; cbn [forms_of] in H.
  - destruct (eq (detq F) 0) eqn:E; [discriminate H|]. injection H as <-. constructor; [|constructor].
    assert (N : Q2R (detq F) <> 0%R) by (rewrite <- Q2R_zero; apply neq_real; rewrite E; reflexivity).
    rewrite form_of_at, reduced_value, Q2R_inv, Q2R_mult, Q2R_one, rm_gram, rm_adj, Q2R_det in *
      by (intros Z; apply Qeq_eqR in Z; rewrite Q2R_mult, Q2R_zero in Z; nra).
    apply ellipsoid_below in I.
    replace (sub (sub y (rv p)) (scale t (rv u))) with (sub (sub y (scale t (rv u))) (rv p)) by (clear; veq).
    pose proof (inverse_below (det (rm F) * det (rm F)) _ ltac:(nra) I). lra.
  - destruct (positive_shapeq M) eqn:P; [|discriminate H]. injection H as <-. constructor; [|constructor].
    apply positive_shapeq_real in P. assert (D : (0 < det (rm M))%R) by apply P.
    rewrite form_of_at, reduced_value, Q2R_inv, Q2R_one, rm_adj, Q2R_det
      by (intros Z; apply Qeq_eqR in Z; rewrite Q2R_det, Q2R_zero in Z; lra).
    apply (shape_below _ _ _ P) in I.
    replace (sub (sub y (rv p)) (scale t (rv u))) with (sub (sub y (scale t (rv u))) (rv p)) by (clear; veq).
    pose proof (inverse_below _ _ D I). lra.
  - injection H as <-. constructor; [|constructor]. rewrite form_of_at, rm_unit, unit_form, Q2R_one, Q2R_mult.
    destruct I as [_ I].
    replace (sub (sub y (rv p)) (scale t (rv u))) with (sub (sub y (scale t (rv u))) (rv p)) by (clear; veq). lra.
  - injection H as <-. constructor.
  - injection H as <-. constructor.
  - destruct (forms_of c u) as [gs|] eqn:E; [|discriminate H]. injection H as <-. destruct I as [I L].
    apply Forall_app. split; [apply (IH _ _ _ _ E I)|]. constructor; [|constructor].
    rewrite form_of_at, Q2R_one.
    replace (sub (sub y (rv p)) (scale t (rv u))) with (sub (sub y (scale t (rv u))) (rv p)) by (clear; veq). lra.
Qed.

(* Forms with multipliers. *)
Fixpoint weighted (ms : list Q) (fs : list terms) : option terms :=
  match ms, fs with
  | [], [] => Some []
  | m :: ms, f :: fs =>
      if le 0 m then match weighted ms fs with Some ts => Some (scaled_terms m f ++ ts) | None => None end else None
  | _, _ => None
  end.
Lemma weighted_real : forall z fs ms ts, weighted ms fs = Some ts -> Forall (fun f => (terms_at f z <= 0)%R) fs ->
  (terms_at ts z <= 0)%R.
Proof.
  intros z; induction fs as [|f fs IH]; intros [|m ms] ts H F; cbn in H; try discriminate H.
  - injection H as <-. cbn. lra.
  - destruct (le 0 m) eqn:M; [|discriminate H]. destruct (weighted ms fs) as [us|] eqn:W; [|discriminate H].
    injection H as <-. inversion F; subst. apply le_real in M. rewrite Q2R_zero in M.
    rewrite app_terms_at, scaled_terms_at. specialize (IH _ _ W H2). nra.
Qed.

(* Linear functions that are not below 0 at a common point. *)
Inductive factor :=
  | One
  | SinceFrom                       (* t - t0 *)
  | BeforeUntil                     (* t1 - t *)
  | OfAgent (a : vec Q)             (* the greatest a.x of its corners, less a.x *)
  | OfObstacle (a : vec Q)
  | OfCut (k : Z).                  (* what the k-th enclosing cut says *)

Definition has_corners (c : convex Q) : bool :=
  match c with Box _ _ | Hull _ => true | Ball _ r => eq r 0 | _ => false end.
Lemma has_corners_real : forall c a x, has_corners c = true -> inside (rc c) x -> (dot (rv a) x <= Q2R (middleq c a))%R.
Proof.
  intros c a x H I. rewrite Q2R_middle. destruct (reach (rc c) x (rv a) I) as [_ L].
  specialize (L 0%R (Rle_refl 0)). rewrite Rmult_0_l, Rplus_0_r in L. apply L.
  destruct c as [p F|p M|p r|lo hi|ps|c p A l]; try discriminate H; cbn [rc bulge]; try lra.
  cbn in H. apply eq_real in H. rewrite Q2R_zero in H. rewrite H. lra.
Qed.

Definition below (h : Q) (a u : vec Q) : linear := sum_linear (constant h) (times_linear (-1) (along a zeroq u)).
Lemma below_at : forall h a u y t, at_point (below h a u) (moment y t)
  = (Q2R h - dot (rv a) (sub y (scale t (rv u))))%R.
Proof.
  intros. unfold below. rewrite sum_linear_at, constant_at, times_linear_at, along_at, rv_zero.
  replace (sub (sub y zero) (scale t (rv u))) with (sub y (scale t (rv u))) by (clear; veq).
  replace (Q2R (-1)) with (-1)%R by (unfold Q2R; cbn; lra). ring.
Qed.

(* One side of a plane: s - a.y >= 0, or a.y - s >= 0. *)
Record cut := CutAt { cut_normal : vec Q; cut_at : Q; is_below : bool }.
Definition cut_linear (c : cut) : linear :=
  let l := below (cut_at c) (cut_normal c) zeroq in if is_below c then l else times_linear (-1) l.
Definition cut_holds (c : cut) (y : vec R) : Prop :=
  if is_below c then (dot (rv (cut_normal c)) y <= Q2R (cut_at c))%R else (Q2R (cut_at c) <= dot (rv (cut_normal c)) y)%R.
Lemma cut_linear_at : forall c y t, cut_holds c y -> (0 <= at_point (cut_linear c) (moment y t))%R.
Proof.
  intros [n s b] y t H. unfold cut_holds, cut_linear in *. cbn [cut_normal cut_at is_below] in *. cbv zeta.
  assert (E : at_point (below s n zeroq) (moment y t) = (Q2R s - dot (rv n) y)%R).
  { rewrite below_at, rv_zero. replace (sub y (scale t zero)) with y by (clear; veq). reflexivity. }
  destruct b; [rewrite E; lra|]. rewrite times_linear_at, E. replace (Q2R (-1)) with (-1)%R by (unfold Q2R; cbn; lra). lra.
Qed.

Section Common.
Variables (a b : convex Q) (w : vec Q) (h : horizon Q).

Definition factor_of (cuts : list cut) (f : factor) : option linear :=
  match f with
  | One => Some (constant 1)
  | SinceFrom => Some [- from h; 0; 0; 0; 1]
  | BeforeUntil => match until h with Some T => Some [T; 0; 0; 0; - (1)] | None => None end
  | OfAgent n => if has_corners a then Some (below (middleq a n) n w) else None
  | OfObstacle n => if has_corners b then Some (below (middleq b n) n zeroq) else None
  | OfCut k => option_map cut_linear (nthq cuts k)
  end.

(* A common point at the time t, y of the obstacle's frame. *)
Definition shared (cuts : list cut) (y : vec R) (t : R) : Prop :=
  in_time (rh h) t /\ inside (rc a) (sub y (scale t (rv w))) /\ inside (rc b) y /\
  Forall (fun c => cut_holds c y) cuts.

Lemma factor_of_real : forall cuts f l y t, factor_of cuts f = Some l -> shared cuts y t -> (0 <= at_point l (moment y t))%R.
Proof.
  intros cuts f l y t H (T & IA & IB & C). destruct f as [| | |n|n|k]; cbn [factor_of] in H.
  - injection H as <-. rewrite constant_at, Q2R_one. lra.
  - injection H as <-. destruct T as [T _]. cbn [rh from] in T. unfold moment. cbn [at_point].
    rewrite Q2R_opp, Q2R_one, Q2R_zero. lra.
  - destruct h as [t0 [t1|]]; [|discriminate H]. cbn in H. injection H as <-. destruct T as [_ T]. cbn in T.
    unfold moment. cbn [at_point]. rewrite Q2R_opp, Q2R_one, Q2R_zero. lra.
  - destruct (has_corners a) eqn:E; [|discriminate H]. injection H as <-. rewrite below_at.
    pose proof (has_corners_real _ n _ E IA). lra.
  - destruct (has_corners b) eqn:E; [|discriminate H]. injection H as <-. rewrite below_at, rv_zero.
    pose proof (has_corners_real _ n _ E IB) as L. replace (sub y (scale t zero)) with y by (clear; veq). lra.
  - destruct (nthq cuts k) as [c|] eqn:E; [|discriminate H]. injection H as <-. rewrite Forall_forall in C.
    apply cut_linear_at, C, (nthq_in _ _ _ _ E).
Qed.

Fixpoint products_of (cuts : list cut) (ps : list (factor * factor * Q)) : option terms :=
  match ps with
  | [] => Some []
  | (f, g, m) :: ps =>
      match factor_of cuts f, factor_of cuts g, products_of cuts ps with
      | Some k, Some l, Some ts => if le 0 m then Some ((- m, k, l) :: ts) else None
      | _, _, _ => None
      end
  end.
Lemma products_of_real : forall cuts ps ts y t, products_of cuts ps = Some ts -> shared cuts y t ->
  (terms_at ts (moment y t) <= 0)%R.
Proof.
  induction ps as [|[[f g] m] ps IH]; intros ts y t H C; cbn [products_of] in H.
  - injection H as <-. cbn. lra.
  - destruct (factor_of cuts f) as [k|] eqn:F; [|discriminate H]. destruct (factor_of cuts g) as [l|] eqn:G; [|discriminate H].
    destruct (products_of cuts ps) as [us|]; [|discriminate H]. destruct (le 0 m) eqn:M; [|discriminate H]. injection H as <-.
    pose proof (factor_of_real _ _ _ _ _ F C) as P. pose proof (factor_of_real _ _ _ _ _ G C) as R.
    specialize (IH _ _ _ eq_refl C). apply le_real in M. rewrite Q2R_zero in M. cbn [terms_at]. rewrite Q2R_opp.
    assert (0 <= at_point k (moment y t) * at_point l (moment y t))%R by (apply Rmult_le_pos; assumption). nra.
Qed.

(* Where they do not move, or there is but one time, the time is no variable. *)
Definition fixed_time : bool :=
  eqv w zeroq || match until h with Some T => eq (from h) T | None => false end.
Definition fix_linear (l : linear) : linear :=
  match l with x0 :: x1 :: x2 :: x3 :: x4 :: _ => [x0 + x4 * from h; x1; x2; x3] | l => l end.
Definition fix_terms (ts : terms) : terms := map (fun t => (fst (fst t), fix_linear (snd (fst t)), fix_linear (snd t))) ts.
Definition moment_fixed (y : vec R) : list R := [1%R; vx y; vy y; vz y].
Lemma fix_linear_at : forall l y, at_point (fix_linear l) (moment_fixed y) = at_point l (moment y (Q2R (from h))).
Proof.
  intros l y. unfold fix_linear, moment, moment_fixed.
  destruct l as [|x0 [|x1 [|x2 [|x3 [|x4 [|x5 l]]]]]]; cbn; rewrite ?Q2R_plus, ?Q2R_mult; ring.
Qed.
Lemma fix_terms_at : forall ts y, terms_at (fix_terms ts) (moment_fixed y) = terms_at ts (moment y (Q2R (from h))).
Proof.
  induction ts as [|[[k l] m] ts IH]; intros y; [reflexivity|]. cbn [fix_terms map terms_at fst snd].
  rewrite !fix_linear_at. unfold fix_terms in IH. rewrite IH. reflexivity.
Qed.
Lemma shared_fixed : forall cuts y t, fixed_time = true -> shared cuts y t -> shared cuts y (Q2R (from h)).
Proof.
  intros cuts y t F ([T0 T1] & IA & IB & C).
  assert (From : in_time (rh h) (Q2R (from h))).
  { split; [cbn; lra|]. destruct h as [t0 [t1|]]; cbn in *; [lra|trivial]. }
  split; [exact From|]. split; [|split; assumption]. unfold fixed_time in F. apply orb_prop in F. destruct F as [F|F].
  - apply eqv_real in F. rewrite F, rv_zero in *.
    replace (sub y (scale (Q2R (from h)) zero)) with (sub y (scale t zero)) by (generalize (Q2R (from h)); clear; veq). exact IA.
  - replace (Q2R (from h)) with t; [exact IA|]. destruct h as [t0 [t1|]]; cbn in *; [|discriminate F].
    apply eq_real in F. lra.
Qed.

Definition forms_out (cuts : list cut) (ms ns : list Q) (ps : list (factor * factor * Q)) : bool :=
  match forms_of a w, forms_of b zeroq with
  | Some fs, Some gs =>
      match weighted ms fs, weighted ns gs, products_of cuts ps with
      | Some ts, Some us, Some vs =>
          let all := ts ++ us ++ vs in
          if fixed_time then definite 4 (matrix_of 4 (fix_terms all)) else definite 5 (matrix_of 5 all)
      | _, _, _ => false
      end
  | _, _ => false
  end.
Lemma forms_out_real : forall cuts ms ns ps, forms_out cuts ms ns ps = true -> forall y t, ~ shared cuts y t.
Proof.
  intros cuts ms ns ps H. unfold forms_out in H.
  destruct (forms_of a w) as [fs|] eqn:FA; [|discriminate H]. destruct (forms_of b zeroq) as [gs|] eqn:FB; [|discriminate H].
  destruct (weighted ms fs) as [ts|] eqn:WA; [|discriminate H]. destruct (weighted ns gs) as [us|] eqn:WB; [|discriminate H].
  destruct (products_of cuts ps) as [vs|] eqn:P; [|discriminate H]. cbv zeta in H.
  assert (Sum : forall y t, shared cuts y t -> (terms_at (ts ++ us ++ vs) (moment y t) <= 0)%R).
  { intros y t C. pose proof C as (T & IA & IB & _).
    assert (IB' : inside (rc b) (sub y (scale t (rv zeroq)))).
    { rewrite rv_zero. replace (sub y (scale t zero)) with y by (clear; veq). exact IB. }
    pose proof (weighted_real _ _ _ _ WA (forms_of_real _ _ _ _ _ FA IA)).
    pose proof (weighted_real _ _ _ _ WB (forms_of_real _ _ _ _ _ FB IB')).
    pose proof (products_of_real _ _ _ _ _ P C). rewrite !app_terms_at. lra. }
  intros y t C. destruct fixed_time eqn:F.
  - pose proof (Sum _ _ (shared_fixed _ _ _ F C)) as N. rewrite <- fix_terms_at in N.
    pose proof (terms_positive 4 _ [vx y; vy y; vz y] H eq_refl) as Q. unfold moment_fixed in N. lra.
  - pose proof (Sum _ _ C) as N.
    pose proof (terms_positive 5 _ [vx y; vy y; vz y; t] H eq_refl) as Q. unfold moment in N. lra.
Qed.
End Common.


(* "c has n.x <= l" by multipliers: (r / L) of their sum + 2 (l - n.x) as a matrix of (1, x). It is definite exactly
   where [[Q, n], [n^T, r^2 / L]] is, with Q, L the sums of the forms' matrices and levels, r = l - n.p. *)
Fixpoint center_of (c : convex Q) : vec Q :=
  match c with Ellipsoid p _ | Shaped p _ | Ball p _ => p | Cut c _ _ _ => center_of c | _ => zeroq end.
Fixpoint levels (c : convex Q) : list Q :=
  match c with Ellipsoid _ _ | Shaped _ _ => [1] | Ball _ r => [r * r] | Cut c _ _ l => levels c ++ [l] | _ => [] end.
Definition no_time : horizon Q := Horizon 0 None.
Definition reach_by (ms : list Q) (n : vec Q) (l : Q) (c : convex Q) : bool :=
  match forms_of c zeroq with
  | None => false
  | Some fs =>
      let r := l - dotq n (center_of c) in
      let L := fold_right (fun p s => fst p * snd p + s) 0 (combine ms (levels c)) in
      match weighted ms fs with
      | None => false
      | Some ts =>
          let k := r / L in
          lt 0 r && lt 0 L && le 0 k &&
          definite 4 (matrix_of 4 (fix_terms no_time ((2, constant 1, below l n zeroq) :: scaled_terms k ts)))
      end
  end.
Lemma reach_by_real : forall ms n l c, reach_by ms n l c = true -> forall x, inside (rc c) x -> (dot (rv n) x <= Q2R l)%R.
Proof.
  intros ms n l c H x I. unfold reach_by in H. destruct (forms_of c zeroq) as [fs|] eqn:F; [|discriminate H]. cbv zeta in H.
  destruct (weighted ms fs) as [ts|] eqn:W; [|discriminate H].
  apply andb_prop in H. destruct H as [H D]. apply andb_prop in H. destruct H as [_ K].
  apply le_real in K. rewrite Q2R_zero in K. set (k := (l - dotq n (center_of c)) / _) in *.
  assert (I' : inside (rc c) (sub x (scale (Q2R 0) (rv zeroq)))).
  { rewrite rv_zero, Q2R_zero. replace (sub x (scale 0 zero)) with x by (clear; veq). exact I. }
  pose proof (weighted_real _ _ _ _ W (forms_of_real _ _ _ _ _ F I')) as N.
  pose proof (terms_positive 4 _ [vx x; vy x; vz x] D eq_refl) as P.
  change [1%R; vx x; vy x; vz x] with (moment_fixed x) in P. rewrite fix_terms_at in P. cbn [no_time from] in P.
  cbn [terms_at] in P. rewrite scaled_terms_at, constant_at, below_at, rv_zero, Q2R_one, Q2R_zero in P.
  rewrite Q2R_zero in N. replace (sub x (scale 0 zero)) with x in P by (clear; veq).
  replace (Q2R 2) with 2%R in P by (unfold Q2R; cbn; lra). nra.
Qed.
