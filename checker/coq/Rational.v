(* The same calculations with rationals, and that they agree with those of reals. *)
From Vericone Require Export Cross.
Require Export ZArith Bool.
Open Scope Q_scope.

Definition rv (a : vec Q) : vec R := Vec (Q2R (vx a)) (Q2R (vy a)) (Q2R (vz a)).
Definition rm (M : mat Q) : mat R := Rows (rv (r1 M)) (rv (r2 M)) (rv (r3 M)).
Fixpoint rc (c : convex Q) : convex R :=
  match c with
  | Ellipsoid p F => Ellipsoid (rv p) (rm F)
  | Shaped p M => Shaped (rv p) (rm M)
  | Ball p r => Ball (rv p) (Q2R r)
  | Box lo hi => Box (rv lo) (rv hi)
  | Hull ps => Hull (map rv ps)
  | Cut c p A l => Cut (rc c) (rv p) (rm A) (Q2R l)
  end.
Definition rh (h : horizon Q) : horizon R := Horizon (Q2R (from h)) (option_map Q2R (until h)).
Definition rk (k : case Q) : case R :=
  Case (map rc (agent k)) (map rc (obstacle k)) (rv (vA k)) (rv (vB k)) (rh (when k)).

Definition zeroq : vec Q := Vec 0 0 0.
Definition addq (a b : vec Q) := Vec (vx a + vx b) (vy a + vy b) (vz a + vz b).
Definition subq (a b : vec Q) := Vec (vx a - vx b) (vy a - vy b) (vz a - vz b).
Definition oppq (a : vec Q) := Vec (- vx a) (- vy a) (- vz a).
Definition scaleq (k : Q) (a : vec Q) := Vec (k * vx a) (k * vy a) (k * vz a).
Definition dotq (a b : vec Q) := vx a * vx b + vy a * vy b + vz a * vz b.
Definition crossq (a b : vec Q) :=
  Vec (vy a * vz b - vz a * vy b) (vz a * vx b - vx a * vz b) (vx a * vy b - vy a * vx b).
Definition mulq (M : mat Q) (u : vec Q) := Vec (dotq (r1 M) u) (dotq (r2 M) u) (dotq (r3 M) u).
Definition turnq (M : mat Q) :=
  Rows (Vec (vx (r1 M)) (vx (r2 M)) (vx (r3 M)))
       (Vec (vy (r1 M)) (vy (r2 M)) (vy (r3 M)))
       (Vec (vz (r1 M)) (vz (r2 M)) (vz (r3 M))).
Definition detq (M : mat Q) := dotq (r1 M) (crossq (r2 M) (r3 M)).
Definition adjq (M : mat Q) := turnq (Rows (crossq (r2 M) (r3 M)) (crossq (r3 M) (r1 M)) (crossq (r1 M) (r2 M))).
Definition formq (M : mat Q) (u : vec Q) := dotq u (mulq M u).

Lemma Q2R_zero : Q2R 0 = 0%R. Proof. unfold Q2R; cbn; lra. Qed.
Lemma Q2R_one : Q2R 1 = 1%R. Proof. unfold Q2R; cbn; lra. Qed.
Lemma Q2R_four : Q2R 4 = 4%R. Proof. unfold Q2R; cbn; lra. Qed.
#[global] Hint Rewrite Q2R_plus Q2R_minus Q2R_mult Q2R_opp Q2R_zero Q2R_one Q2R_four : q2r.

Lemma rv_add : forall a b, rv (addq a b) = add (rv a) (rv b).
Proof. intros; unfold rv, addq, add; cbn; autorewrite with q2r; reflexivity. Qed.
Lemma rv_sub : forall a b, rv (subq a b) = sub (rv a) (rv b).
Proof. intros; unfold rv, subq, sub; cbn; autorewrite with q2r; reflexivity. Qed.
Lemma rv_opp : forall a, rv (oppq a) = opp (rv a).
Proof. intros; unfold rv, oppq, opp; cbn; autorewrite with q2r; reflexivity. Qed.
Lemma rv_scale : forall k a, rv (scaleq k a) = scale (Q2R k) (rv a).
Proof. intros; unfold rv, scaleq, scale; cbn; autorewrite with q2r; reflexivity. Qed.
Lemma rv_zero : rv zeroq = zero.
Proof. unfold rv, zeroq, zero; cbn; autorewrite with q2r; reflexivity. Qed.
Lemma Q2R_dot : forall a b, Q2R (dotq a b) = dot (rv a) (rv b).
Proof. intros; unfold rv, dotq, dot; cbn; autorewrite with q2r; reflexivity. Qed.
Lemma rv_cross : forall a b, rv (crossq a b) = cross (rv a) (rv b).
Proof. intros; unfold rv, crossq, cross; cbn; autorewrite with q2r; reflexivity. Qed.
Lemma rm_turn : forall M, rm (turnq M) = turn (rm M). Proof. reflexivity. Qed.
#[global] Hint Rewrite rv_add rv_sub rv_opp rv_scale rv_zero Q2R_dot rv_cross rm_turn : q2r.
Lemma rv_mul : forall M u, rv (mulq M u) = mul (rm M) (rv u).
Proof. intros; unfold mulq, mul, rm. cbn [r1 r2 r3]. rewrite <- !Q2R_dot. reflexivity. Qed.
Lemma Q2R_det : forall M, Q2R (detq M) = det (rm M).
Proof. intros; unfold detq, det. autorewrite with q2r. reflexivity. Qed.
Lemma rm_adj : forall M, rm (adjq M) = adj (rm M).
Proof. intros; unfold adjq, adj. rewrite rm_turn. unfold rm at 1. cbn [r1 r2 r3]. autorewrite with q2r. reflexivity. Qed.
#[global] Hint Rewrite rv_mul Q2R_det rm_adj : q2r.
Lemma Q2R_form : forall M u, Q2R (formq M u) = form (rm M) (rv u).
Proof. intros; unfold formq, form. autorewrite with q2r. reflexivity. Qed.
#[global] Hint Rewrite Q2R_form : q2r.

(* Comparisons. *)
Definition le (x y : Q) : bool := Qle_bool x y.
Definition lt (x y : Q) : bool := negb (Qle_bool y x).
Definition eq (x y : Q) : bool := Qeq_bool x y.

Lemma le_real : forall x y, le x y = true -> (Q2R x <= Q2R y)%R.
Proof. intros x y H. apply Qle_Rle, Qle_bool_iff, H. Qed.
Lemma lt_real : forall x y, lt x y = true -> (Q2R x < Q2R y)%R.
Proof.
  intros x y H. apply Qlt_Rlt, Qnot_le_lt. intros L. apply Qle_bool_iff in L. unfold lt in H. rewrite L in H. discriminate H.
Qed.
Lemma eq_real : forall x y, eq x y = true -> Q2R x = Q2R y.
Proof. intros x y H. apply Qeq_eqR, Qeq_bool_iff, H. Qed.
Lemma neq_real : forall x y, negb (eq x y) = true -> Q2R x <> Q2R y.
Proof.
  intros x y H E. apply eqR_Qeq, Qeq_bool_iff in E. unfold eq in H. rewrite E in H. discriminate H.
Qed.

Definition maxq (x y : Q) := if le x y then y else x.
Lemma Q2R_max : forall x y, Q2R (maxq x y) = Rmax (Q2R x) (Q2R y).
Proof.
  intros x y. unfold maxq. destruct (le x y) eqn:E.
  - apply le_real in E. symmetry. apply Rmax_right, E.
  - assert (L : lt y x = true) by (unfold lt; unfold le in E; rewrite E; reflexivity).
    apply lt_real in L. symmetry. apply Rmax_left. lra.
Qed.
#[global] Hint Rewrite Q2R_max : q2r.

(* Lowest terms. *)
Definition reduced (x : Q) : Q := Qred x.
Lemma reduced_value : forall x, Q2R (reduced x) = Q2R x.
Proof. intros x. apply Qeq_eqR, Qred_correct. Qed.
Arguments reduced x : simpl never.

(* Supports. *)
Fixpoint highestq (n : vec Q) (ps : list (vec Q)) : Q :=
  match ps with
  | [] => 0
  | [p] => dotq n p
  | p :: ps => maxq (dotq n p) (highestq n ps)
  end.
Lemma Q2R_highest : forall n ps, Q2R (highestq n ps) = highest (rv n) (map rv ps).
Proof.
  intros n; induction ps as [|p ps IH]; [apply Q2R_zero|]. destruct ps as [|q ps].
  - apply Q2R_dot.
  - change (highestq n (p :: q :: ps)) with (maxq (dotq n p) (highestq n (q :: ps))).
    rewrite Q2R_max, Q2R_dot, IH. reflexivity.
Qed.

Fixpoint middleq (c : convex Q) (n : vec Q) : Q :=
  match c with
  | Ellipsoid p _ | Shaped p _ | Ball p _ => dotq n p
  | Box lo hi => maxq (vx n * vx lo) (vx n * vx hi) + maxq (vy n * vy lo) (vy n * vy hi)
                 + maxq (vz n * vz lo) (vz n * vz hi)
  | Hull ps => highestq n ps
  | Cut c _ _ _ => middleq c n
  end.
Fixpoint bulgeq (c : convex Q) (n : vec Q) : Q :=
  match c with
  | Ellipsoid _ F => let m := mulq (turnq F) n in dotq m m
  | Shaped _ M => formq M n
  | Ball _ r => r * r * dotq n n
  | Cut c _ _ _ => bulgeq c n
  | _ => 0
  end.
Lemma Q2R_middle : forall c n, Q2R (middleq c n) = middle (rc c) (rv n).
Proof.
  induction c as [p F|p M|p r|lo hi|ps|c IH p A l]; intros n; cbn [middleq middle rc]; try apply Q2R_dot; [..|apply IH].
  - autorewrite with q2r. reflexivity.
  - apply Q2R_highest.
Qed.
Lemma Q2R_bulge : forall c n, Q2R (bulgeq c n) = bulge (rc c) (rv n).
Proof.
  induction c as [p F|p M|p r|lo hi|ps|c IH p A l]; intros n; cbn [bulgeq bulge rc]; [..|apply IH]; cbv zeta;
    autorewrite with q2r; reflexivity.
Qed.
#[global] Hint Rewrite Q2R_middle Q2R_bulge : q2r.

(* Boolean facts to facts of reals. *)
Ltac real :=
  repeat match goal with
  | H : (_ && _)%bool = true |- _ => apply andb_prop in H; destruct H
  | H : le _ _ = true |- _ => apply le_real in H
  | H : lt _ _ = true |- _ => apply lt_real in H
  | H : eq _ _ = true |- _ => apply eq_real in H
  | H : negb (eq _ _) = true |- _ => apply neq_real in H
  end; autorewrite with q2r in *.

Definition reach_belowq (n : vec Q) (l : Q) (c : convex Q) : bool :=
  let r := l - middleq c n in le 0 r && le (bulgeq c n) (r * r).
Lemma reach_belowq_real : forall n l c, reach_belowq n l c = true -> reach_below (rv n) (Q2R l) (rc c).
Proof. intros n l c H. unfold reach_belowq in H. cbv zeta in H. real. split; assumption. Qed.

Definition beyondq (gap qA qB : Q) : bool :=
  let g := gap * gap - qA - qB in lt 0 gap && lt 0 g && lt (4 * (qA * qB)) (g * g).
Lemma beyondq_real : forall gap qA qB, beyondq gap qA qB = true -> beyond (Q2R gap) (Q2R qA) (Q2R qB).
Proof. intros gap qA qB H. unfold beyondq in H. cbv zeta in H. real. split; [assumption|]. split; [assumption|]. lra. Qed.

(* How much nearer along n they come, at most: none if without bound. *)
Definition slideq (n w : vec Q) (h : horizon Q) : option Q :=
  let s := dotq n w in
  match until h with
  | None => if le s 0 then Some (from h * s) else None
  | Some T => Some (maxq (from h * s) (T * s))
  end.
Lemma slideq_real : forall n w h s, slideq n w h = Some s -> slides (rv n) (rv w) (rh h) (Q2R s).
Proof.
  intros n w [t0 [T|]] s H; unfold slideq in H; cbn in *.
  - injection H as <-. unfold slides. cbn. autorewrite with q2r. split; [apply Rmax_l | apply Rmax_r].
  - destruct (le (dotq n w) 0) eqn:E; [|discriminate H]. injection H as <-.
    unfold slides. cbn. real. split; [apply Rle_refl | assumption].
Qed.

Definition in_timeq (h : horizon Q) (t : Q) : bool :=
  le (from h) t && match until h with None => true | Some T => le t T end.
Lemma in_timeq_real : forall h t, in_timeq h t = true -> in_time (rh h) (Q2R t).
Proof. intros [t0 [T|]] t H; unfold in_timeq in H; cbn in H; real; split; cbn; trivial. Qed.

(* Points. *)
Definition positive_shapeq (M : mat Q) : bool :=
  eq (vy (r1 M)) (vx (r2 M)) && eq (vz (r1 M)) (vx (r3 M)) && eq (vz (r2 M)) (vy (r3 M)) &&
  lt 0 (vx (r1 M)) && lt 0 (vx (r1 M) * vy (r2 M) - vy (r1 M) * vy (r1 M)) && lt 0 (detq M).
Lemma positive_shapeq_real : forall M, positive_shapeq M = true -> positive_shape (rm M).
Proof.
  intros M H. unfold positive_shapeq in H. real. repeat (split; [assumption|]). assumption.
Qed.

Definition lessq (strictly : bool) (x y : Q) : bool := if strictly then lt x y else le x y.
Lemma lessq_real : forall s x y, lessq s x y = true -> (Q2R x <= Q2R y)%R /\ (s = true -> (Q2R x < Q2R y)%R).
Proof.
  intros [] x y H; unfold lessq in H; [apply lt_real in H | apply le_real in H]; split; intros; try discriminate; lra.
Qed.

Fixpoint meanq (ws : list Q) (ps : list (vec Q)) : vec Q :=
  match ws, ps with w :: ws, p :: ps => addq (scaleq w p) (meanq ws ps) | _, _ => zeroq end.
Lemma rv_mean : forall ps ws, rv (meanq ws ps) = mean (map Q2R ws) (map rv ps).
Proof.
  induction ps as [|p ps IH]; intros [|w ws]; try apply rv_zero. cbn. rewrite rv_add, rv_scale, IH. reflexivity.
Qed.
Definition totalq (ws : list Q) := fold_right Qplus 0 ws.
Lemma Q2R_total : forall ws, Q2R (totalq ws) = total (map Q2R ws).
Proof.
  induction ws as [|w ws IH]; [apply Q2R_zero|]. unfold totalq, total in *. cbn. rewrite Q2R_plus, IH. reflexivity.
Qed.
Definition eqv (a b : vec Q) : bool := eq (vx a) (vx b) && eq (vy a) (vy b) && eq (vz a) (vz b).
Lemma eqv_real : forall a b, eqv a b = true -> rv a = rv b.
Proof. intros a b H. unfold eqv in H. real. unfold rv. congruence. Qed.

(* Three of the vectors, in no plane through the origin. *)
Definition spreadq (ds : list (vec Q)) : bool :=
  existsb (fun a => existsb (fun b => existsb (fun c => negb (eq (detq (turnq (Rows a b c))) 0)) ds) ds) ds.
Lemma spreadq_real : forall ds, spreadq ds = true -> spread (map rv ds).
Proof.
  intros ds H. unfold spreadq in H. apply existsb_exists in H. destruct H as (a & A & H).
  apply existsb_exists in H. destruct H as (b & B & H). apply existsb_exists in H. destruct H as (c & C & H).
  exists (rv a), (rv b), (rv c). repeat (split; [apply in_map; assumption|]). real. exact H.
Qed.

(* The element with an index. *)
Fixpoint nthq {T : Type} (l : list T) (k : Z) : option T :=
  match l with [] => None | x :: l => if (k =? 0)%Z then Some x else nthq l (k - 1) end.
Lemma nthq_in : forall T (l : list T) k x, nthq l k = Some x -> In x l.
Proof.
  induction l as [|y l IH]; intros k x H; [discriminate H|]. cbn in H.
  destruct (k =? 0)%Z; [injection H as <-; left; reflexivity | right; apply (IH _ _ H)].
Qed.

Definition places := list (Z * Q). (* corners and their weights *)
Fixpoint chosenq (ps : list (vec Q)) (s : places) : option (list (vec Q)) :=
  match s with
  | [] => Some []
  | (k, _) :: s => match nthq ps k, chosenq ps s with Some p, Some qs => Some (p :: qs) | _, _ => None end
  end.
Lemma chosenq_in : forall ps s qs, chosenq ps s = Some qs -> Forall (fun q => In q ps) qs /\ length s = length qs.
Proof.
  induction s as [|[k w] s IH]; intros qs H; cbn in H.
  - injection H as <-. split; constructor.
  - destruct (nthq ps k) eqn:E; [|discriminate H]. destruct (chosenq ps s) eqn:F; [|discriminate H].
    injection H as <-. destruct (IH l eq_refl) as [A B]. split; [constructor; [apply (nthq_in _ _ _ _ E)|exact A]|].
    cbn. rewrite B. reflexivity.
Qed.

Fixpoint memberq (strictly : bool) (c : convex Q) (s : places) (x : vec Q) : bool :=
  match c with
  | Ellipsoid p F => let m := mulq (adjq F) (subq x p) in
      negb (eq (detq F) 0) && lessq strictly (dotq m m) (detq F * detq F)
  | Shaped p M => positive_shapeq M && lessq strictly (formq (adjq M) (subq x p)) (detq M)
  | Ball p r => le 0 r && lessq strictly (dotq (subq x p) (subq x p)) (r * r)
  | Box lo hi => lessq strictly (vx lo) (vx x) && lessq strictly (vx x) (vx hi) && lessq strictly (vy lo) (vy x) &&
      lessq strictly (vy x) (vy hi) && lessq strictly (vz lo) (vz x) && lessq strictly (vz x) (vz hi)
  | Cut c p A l => memberq strictly c s x && lessq strictly (formq A (subq x p)) l
  | Hull ps => match chosenq ps s with
      | None => false
      | Some qs => forallb (lt 0) (map snd s) && eq (totalq (map snd s)) 1 && eqv x (meanq (map snd s) qs) &&
          (negb strictly || match qs with q :: qs => spreadq (map (fun c => subq c q) qs) | [] => false end)
      end
  end.

Lemma positive_real : forall ws, forallb (lt 0) ws = true -> Forall (fun w => (0 < w)%R) (map Q2R ws).
Proof.
  induction ws as [|w ws IH]; intros H; [constructor|]. cbn in H. apply andb_prop in H. destruct H as [A B].
  apply lt_real in A. rewrite Q2R_zero in A. constructor; auto.
Qed.

Lemma memberq_hull : forall strictly ps s x, memberq strictly (Hull ps) s x = true ->
  exists ws qs, holds (rc (Hull ps)) ws qs (rv x) /\ (strictly = true -> deep (rc (Hull ps)) ws qs (rv x)).
Proof.
  intros strictly ps s x H. cbn [memberq] in H. destruct (chosenq ps s) as [qs|] eqn:E; [|discriminate H].
  apply andb_prop in H. destruct H as [H S]. apply andb_prop in H. destruct H as [H X].
  apply andb_prop in H. destruct H as [P T].
  destruct (chosenq_in _ _ _ E) as [I L]. apply positive_real in P. apply eq_real in T.
  rewrite Q2R_total, Q2R_one in T. apply eqv_real in X. rewrite rv_mean in X.
  exists (map Q2R (map snd s)), (map rv qs).
  assert (G : holds (rc (Hull ps)) (map Q2R (map snd s)) (map rv qs) (rv x)).
  { cbn. repeat split; try assumption; [rewrite !map_length; assumption|].
    apply Forall_map. eapply Forall_impl; [|exact I]. cbn. intros. apply in_map. assumption. }
  split; [exact G|]. intros ->. cbn [rc deep]. split; [exact G|]. cbn in S.
  destruct qs as [|q qs]; [discriminate S|]. apply spreadq_real in S. cbn.
  rewrite map_map in *. erewrite map_ext; [exact S|]. intros. cbn. rewrite rv_sub. reflexivity.
Qed.

Lemma memberq_base : forall strictly c s x, match c with Cut _ _ _ _ => False | _ => True end ->
  memberq strictly c s x = true -> inside (rc c) (rv x) /\ (strictly = true -> interior (rc c) (rv x)).
Proof.
  intros strictly c s x Base H.
  assert (G : exists ws qs, holds (rc c) ws qs (rv x) /\ (strictly = true -> deep (rc c) ws qs (rv x))).
  { destruct c as [p F|p M|p r|lo hi|ps|c p A l]; [exists [], [].. | apply (memberq_hull _ _ _ _ H) | contradiction]; cbn [memberq] in H; cbv zeta in H;
      repeat match goal with K : (_ && _)%bool = true |- _ => apply andb_prop in K; destruct K end;
      repeat match goal with K : lessq _ _ _ = true |- _ => apply lessq_real in K; destruct K end;
      cbn [rc holds deep].
    - match goal with K : negb _ = true |- _ => apply neq_real in K; rewrite Q2R_det, Q2R_zero in K end.
      rewrite Q2R_dot, rv_mul, rm_adj, rv_sub, Q2R_mult, Q2R_det in *. auto.
    - match goal with K : positive_shapeq _ = true |- _ => apply positive_shapeq_real in K end.
      rewrite Q2R_form, rm_adj, rv_sub, Q2R_det in *. auto.
    - match goal with K : le _ _ = true |- _ => apply le_real in K; rewrite Q2R_zero in K end.
      rewrite Q2R_dot, rv_sub, Q2R_mult in *. auto.
    - cbn [rv vx vy vz]. auto 10. }
  destruct G as (ws & qs & A & B). split; [apply (holds_inside _ _ _ _ A)|]. intros S. apply (deep_interior _ _ _ _ (B S)).
Qed.

Lemma memberq_inside : forall strictly c s x, memberq strictly c s x = true ->
  inside (rc c) (rv x) /\ (strictly = true -> interior (rc c) (rv x)).
Proof.
  intros strictly c s x. induction c as [p F|p M|p r|lo hi|ps|c IH p A l]; intros H;
    [apply (memberq_base strictly _ s); [exact I|exact H]..|]. cbn [memberq] in H.
  apply andb_prop in H. destruct H as [H L]. apply lessq_real in L. destruct L as [L S].
  rewrite Q2R_form, rv_sub in L, S. destruct (IH H) as [X D]. cbn [rc]. split; [split; assumption|].
  intros T. apply cut_interior; auto.
Qed.
