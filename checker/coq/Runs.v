(* The checker of runs and its theorem. *)
From Vericone Require Export Forms.
Open Scope Q_scope.

Definition rg (g : segment Q) : segment R :=
  Segment (Q2R (starts g)) (Q2R (ends g)) (map rv (positions g))
    (map (fun q => Quaternion (Q2R (qw q)) (Q2R (qx q)) (Q2R (qy q)) (Q2R (qz q))) (turns g)).
Definition rr (r : runner Q) : runner R := Runner (map rc (its_body r)) (map rg (track r)) (Q2R (radius r)).

(* Vectors and quaternions of forms. *)
Definition dotf (a : vec Q) (m : vec form_q) : form_q :=
  sum (times (vx a) (vx m)) (sum (times (vy a) (vy m)) (times (vz a) (vz m))).
Definition minus (p q : form_q) : form_q := sum p (times (-1) q).
Definition squares (a b c : form_q) : form_q := sum (product a a) (sum (product b b) (product c c)).

(* N(q)^T n and q.q *)
Definition unturn (q : quaternion form_q) (n : vec Q) : vec form_q :=
  let (w, x, y, z) := q in
  let ww := product w w in let xx := product x x in let yy := product y y in let zz := product z z in
  let wx := times 2 (product w x) in let wy := times 2 (product w y) in let wz := times 2 (product w z) in
  let xy := times 2 (product x y) in let xz := times 2 (product x z) in let yz := times 2 (product y z) in
  Vec (dotf n (Vec (minus (sum ww xx) (sum yy zz)) (sum xy wz) (minus xz wy)))
      (dotf n (Vec (minus xy wz) (minus (sum ww yy) (sum xx zz)) (sum yz wx)))
      (dotf n (Vec (sum xz wy) (minus yz wx) (minus (sum ww zz) (sum xx yy)))).
Definition squaref (q : quaternion form_q) : form_q :=
  sum (sum (product (qw q) (qw q)) (product (qx q) (qx q))) (sum (product (qy q) (qy q)) (product (qz q) (qz q))).

(* n.(q.q R x) <= l for the points x of a piece; m = N(q)^T n. *)
Fixpoint reach_form (m : vec form_q) (l : form_q) (c : convex Q) : bool :=
  match c with
  | Ellipsoid p F =>
      let r := minus l (dotf p m) in let G := turnq F in
      not_negative r && not_negative (minus (product r r) (squares (dotf (r1 G) m) (dotf (r2 G) m) (dotf (r3 G) m)))
  | Shaped p M =>
      let r := minus l (dotf p m) in
      not_negative r && not_negative (minus (product r r)
        (sum (product (vx m) (dotf (r1 M) m)) (sum (product (vy m) (dotf (r2 M) m)) (product (vz m) (dotf (r3 M) m)))))
  | Ball p s =>
      let r := minus l (dotf p m) in
      not_negative r && not_negative (minus (product r r) (times (s * s) (squares (vx m) (vy m) (vz m))))
  | Cut c _ _ _ => reach_form m l c
  | Box _ _ | Hull _ => forallb (fun v => not_negative (minus l (dotf v m))) (corners c)
  end.

(* A segment's coefficients on the part from a to b. *)
Definition parts (g : segment Q) (a b : Q) (bs : list Q) : form_q :=
  let span := ends g - starts g in
  let x := reduced ((a - starts g) / span) in
  let y := reduced ((b - starts g) / span) in
  part (of_bernstein bs) [reduced (1 - x); reduced (1 - y)] [x; y].
Definition positionf (g : segment Q) (a b : Q) : vec form_q :=
  Vec (parts g a b (map vx (positions g))) (parts g a b (map vy (positions g))) (parts g a b (map vz (positions g))).
Definition turnedf (g : segment Q) (a b : Q) : quaternion form_q :=
  Quaternion (parts g a b (map qw (turns g))) (parts g a b (map qx (turns g)))
             (parts g a b (map qy (turns g))) (parts g a b (map qz (turns g))).

Record plane := PlaneOf { its_normal : vec Q; its_length : Q; at_most_a : list Q; at_most_b : list Q }.

(* The plane parts the groups while they are on the segments f and g, from a to b. *)
Definition plane_apart (d ra rb : Q) (A B : group) (f g : segment Q) (a b : Q) (p : plane) : bool :=
  let n := its_normal p in
  let la := of_bernstein (at_most_a p) in
  let lb := of_bernstein (at_most_b p) in
  let qf := turnedf f a b in
  let qg := turnedf g a b in
  let sf := squaref qf in
  let sg := squaref qg in
  let mf := unturn qf n in
  let mg := unturn qg (oppq n) in
  let lf := product la sf in
  let lg := product lb sg in
  le (starts f) a && le b (ends f) && le (starts g) a && le b (ends g) &&
  le 0 (its_length p) && le (dotq n n) (its_length p * its_length p) &&
  positive sf && positive sg &&
  forallb (fun c => reach_form mf lf (snd c)) A && forallb (fun c => reach_form mg lg (snd c)) B &&
  positive (minus (minus (dotf n (positionf g a b)) (dotf n (positionf f a b)))
    (sum (sum la lb) [(ra + rb + d) * its_length p])).

(* Segments that share more than an instant with the time from a to b. *)
Definition meets_time (a b : Q) (g : segment Q) : bool := lt (starts g) b && lt a (ends g).
Definition stretch (d : Q) (P R : runner Q) (A B : group) (a b : Q) (p : plane) : bool :=
  forallb (fun f => forallb (fun g => plane_apart d (radius P) (radius R) A B f g a b p)
    (filter (meets_time a b) (track R))) (filter (meets_time a b) (track P)).
(* Pieces one after another: each from the end of the one before. *)
Fixpoint pieces_apart (d : Q) (P R : runner Q) (A B : group) (a to : Q) (ps : list (Q * plane)) : bool :=
  match ps with
  | [] => eq a to
  | (b, p) :: ps => lt a b && stretch d P R A B a b p && pieces_apart d P R A B b to ps
  end.

Inductive run_proof :=
  | Pieces (first : Q) (ps : list (Q * plane))           (* the end of each piece, its plane *)
  | PiecesOf (of_agent : bool) (runs : list (Z * Z)) (proofs : list run_proof)
  | PartsOfTime (cuts : list Q) (proofs : list run_proof)
  (* boxes that hold the pieces, the agent's or the obstacle's, and a proof of them *)
  | Covered (of_agent : bool) (boxes : list (vec Q * vec Q)) (runs : list (Z * Z)) (p : run_proof).

(* From one cut to the next one. *)
Fixpoint in_turn (chk : Q -> Q -> run_proof -> bool) (a to : Q) (cuts : list Q) (proofs : list run_proof) : bool :=
  match cuts, proofs with
  | [], [p] => chk a to p
  | c :: cuts, p :: proofs => lt a c && lt c to && chk a c p && in_turn chk c to cuts proofs
  | _, _ => false
  end.

Fixpoint check_run (fuel : nat) (d from to : Q) (P R : runner Q) (A B : group) (p : run_proof) : bool :=
  match fuel with
  | O => false
  | S fuel =>
      match p with
      | Pieces first ps => eq first from && pieces_apart d P R A B from to ps
      | PiecesOf true runs proofs => in_groups (fun g p => check_run fuel d from to P R g B p) runs proofs A
      | PiecesOf false runs proofs => in_groups (fun g p => check_run fuel d from to P R A g p) runs proofs B
      | PartsOfTime cuts proofs => in_turn (fun a b p => check_run fuel d a b P R A B p) from to cuts proofs
      | Covered true boxes runs p =>
          in_groups covers runs boxes A && check_run fuel d from to P R (numbered 0 (map box_of boxes)) B p
      | Covered false boxes runs p =>
          in_groups covers runs boxes B && check_run fuel d from to P R A (numbered 0 (map box_of boxes)) p
      end
  end.

(* That segments follow one another, from `from` or before to `to` or after. *)
Fixpoint follow (at_ : Q) (to : Q) (gs : list (segment Q)) : bool :=
  match gs with
  | [] => le to at_
  | g :: gs => eq (starts g) at_ && lt (starts g) (ends g) && follow (ends g) to gs
  end.
Definition well_formed_runner (from to : Q) (r : runner Q) : bool :=
  filled (its_body r) && le 0 (radius r) &&
  match track r with [] => false | g :: _ => le (starts g) from && follow (starts g) to (track r) end.
Definition check_apart (d from to : Q) (P R : runner Q) (p : run_proof) : bool :=
  le 0 d && lt from to && well_formed_runner from to P && well_formed_runner from to R &&
  check_run depth d from to P R (numbered 0 (its_body P)) (numbered 0 (its_body R)) p.

Section OnPiece.
Variables s t : R.
Hypothesis one : (s + t = 1)%R.
Hypothesis s0 : (0 <= s)%R.
Hypothesis t0 : (0 <= t)%R.
Notation V p := (value p s t).

Definition values (m : vec form_q) : vec R := Vec (V (vx m)) (V (vy m)) (V (vz m)).
Definition valuesq (q : quaternion form_q) : quaternion R := Quaternion (V (qw q)) (V (qx q)) (V (qy q)) (V (qz q)).

Lemma minus_value : forall p q, V (minus p q) = (V p - V q)%R.
Proof.
  intros. unfold minus. rewrite sum_value, times_value by assumption.
  replace (Q2R (-1)) with (-1)%R by (unfold Q2R; cbn; lra). ring.
Qed.
Lemma dotf_value : forall a m, V (dotf a m) = dot (rv a) (values m).
Proof. intros. unfold dotf. rewrite !sum_value, !times_value by assumption. unfold dot, values, rv. cbn [vx vy vz]. ring. Qed.
Lemma squares_value : forall a b c, V (squares a b c) = (V a * V a + V b * V b + V c * V c)%R.
Proof. intros. unfold squares. rewrite !sum_value, !product_value by assumption. ring. Qed.
Lemma squaref_value : forall q, V (squaref q) = square (valuesq q).
Proof. intros. unfold squaref. rewrite !sum_value, !product_value by assumption. unfold square, valuesq. cbn [qw qx qy qz]. ring. Qed.
Lemma unturn_value : forall q n, values (unturn q n) = mul (turn (rotation (valuesq q))) (rv n).
Proof.
  intros [w x y z] [a b c]. unfold values, unturn. cbn [vx vy vz].
  rewrite !dotf_value. unfold values. cbn [vx vy vz].
  repeat rewrite ?minus_value, ?sum_value, ?times_value, ?product_value by assumption.
  replace (Q2R 2) with 2%R by (unfold Q2R; cbn; lra).
  unfold valuesq, rotation, mul, turn, dot, rv. cbn [qw qx qy qz r1 r2 r3 vx vy vz]. f_equal; ring.
Qed.

Lemma reach_form_real : forall m l c, reach_form m l c = true ->
  forall x, inside (rc c) x -> (dot (values m) x <= V l)%R.
Proof.
  intros m l c H x I.
  assert (Hull_case : forall ps, forallb (fun v => not_negative (minus l (dotf v m))) ps = true ->
    forall v, In v (map rv ps) -> (dot (values m) v <= V l)%R).
  { intros ps F v J. apply in_map_iff in J. destruct J as (w & <- & J). rewrite forallb_forall in F.
    pose proof (not_negative_value s t s0 t0 _ (F _ J)) as N. rewrite minus_value, dotf_value, dot_sym in N. lra. }
  induction c as [p F|p M|p r|lo hi|ps|c IH p A k]; cbn [reach_form] in H; cbv zeta in H; [..|apply IH; [exact H|apply I]].
  - apply andb_prop in H. destruct H as [R Q]. apply (not_negative_value s t s0 t0) in R, Q.
    rewrite minus_value, dotf_value, dot_sym in R. rewrite minus_value, product_value, squares_value, !minus_value, !dotf_value in Q by assumption.
    apply (reach_below_sound (rc (Ellipsoid p F)) _ _ _); [|exact I]. unfold reach_below. cbn [rc middle bulge]. split; [exact R|].
    replace (dot (mul (turn (rm F)) (values m)) (mul (turn (rm F)) (values m)))
      with (dot (rv (r1 (turnq F))) (values m) * dot (rv (r1 (turnq F))) (values m)
        + dot (rv (r2 (turnq F))) (values m) * dot (rv (r2 (turnq F))) (values m)
        + dot (rv (r3 (turnq F))) (values m) * dot (rv (r3 (turnq F))) (values m))%R by reflexivity.
    rewrite (dot_sym (rv p)) in Q. lra.
  - apply andb_prop in H. destruct H as [R Q]. apply (not_negative_value s t s0 t0) in R, Q.
    rewrite minus_value, dotf_value in R.
    rewrite minus_value, !sum_value, !product_value, !minus_value, !dotf_value in Q by assumption.
    apply (reach_below_sound (rc (Shaped p M)) _ _ _); [|exact I]. unfold reach_below. cbn [rc middle bulge].
    rewrite (dot_sym (values m)). split; [exact R|].
    replace (form (rm M) (values m)) with (V (vx m) * dot (rv (r1 M)) (values m) + V (vy m) * dot (rv (r2 M)) (values m)
        + V (vz m) * dot (rv (r3 M)) (values m))%R by reflexivity. lra.
  - apply andb_prop in H. destruct H as [R Q]. apply (not_negative_value s t s0 t0) in R, Q.
    rewrite minus_value, dotf_value in R.
    rewrite minus_value, times_value, product_value, squares_value, !minus_value, !dotf_value, Q2R_mult in Q by assumption.
    apply (reach_below_sound (rc (Ball p r)) _ _ _); [|exact I]. unfold reach_below. cbn [rc middle bulge].
    rewrite (dot_sym (values m)). split; [exact R|]. unfold dot at 1. cbn [values vx vy vz]. lra.
  - pose proof (Hull_case _ H) as C. destruct lo as [a b c], hi as [a' b' c']. cbn [rc inside] in I. destruct I as (X & Y & Z).
    cbn [rv vx vy vz] in X, Y, Z.
    unfold dot at 1.
    pose proof (product_max (vx (values m)) _ _ _ X) as HX. pose proof (product_max (vy (values m)) _ _ _ Y) as HY.
    pose proof (product_max (vz (values m)) _ _ _ Z) as HZ.
    assert (In8 : forall v, In v [Vec a b c; Vec a' b c; Vec a b' c; Vec a' b' c; Vec a b c'; Vec a' b c'; Vec a b' c';
      Vec a' b' c'] -> (dot (values m) (rv v) <= V l)%R) by (intros v J; apply C, in_map, J).
    cbn in In8. unfold dot in In8.
    pose proof (In8 (Vec a b c) ltac:(tauto)). pose proof (In8 (Vec a' b c) ltac:(tauto)).
    pose proof (In8 (Vec a b' c) ltac:(tauto)). pose proof (In8 (Vec a' b' c) ltac:(tauto)).
    pose proof (In8 (Vec a b c') ltac:(tauto)). pose proof (In8 (Vec a' b c') ltac:(tauto)).
    pose proof (In8 (Vec a b' c') ltac:(tauto)). pose proof (In8 (Vec a' b' c') ltac:(tauto)).
    cbn [rv vx vy vz values] in *.
    revert HX HY HZ. unfold Rmax. repeat destruct Rle_dec; intros; lra.
  - pose proof (Hull_case _ H) as C. cbn [corners] in C. apply (hull_between _ _ _ _ I C).
Qed.
End OnPiece.

(* The forms of a segment have its values. *)
Lemma parts_value : forall g a b bs x, (Q2R (starts g) < Q2R (ends g))%R -> (Q2R a < Q2R b)%R -> (Q2R a <= x <= Q2R b)%R ->
  let t := ((x - Q2R a) / (Q2R b - Q2R a))%R in
  value (parts g a b bs) (1 - t) t = bernstein (map Q2R bs) ((x - Q2R (starts g)) / (Q2R (ends g) - Q2R (starts g)))%R.
Proof.
  intros g a b bs x G AB X t. unfold parts. cbv zeta.
  assert (NZ : ~ ends g - starts g == 0).
  { intros E. apply Qeq_eqR in E. rewrite Q2R_minus, Q2R_zero in E. lra. }
  rewrite part_value by (unfold t; lra). rewrite <- of_bernstein_value.
  f_equal; unfold value; cbn; repeat rewrite ?reduced_value, ?Q2R_minus, ?Q2R_one, ?Q2R_div by assumption;
    unfold t; field; lra.
Qed.

Lemma positionf_value : forall g a b x, (Q2R (starts g) < Q2R (ends g))%R -> (Q2R a < Q2R b)%R -> (Q2R a <= x <= Q2R b)%R ->
  let t := ((x - Q2R a) / (Q2R b - Q2R a))%R in values (1 - t) t (positionf g a b) = position (rg g) x.
Proof.
  intros g a b x G AB X t. unfold values, positionf, position, t. cbn [vx vy vz rg starts ends positions].
  rewrite !parts_value, !map_map by assumption. reflexivity.
Qed.
Lemma turnedf_value : forall g a b x, (Q2R (starts g) < Q2R (ends g))%R -> (Q2R a < Q2R b)%R -> (Q2R a <= x <= Q2R b)%R ->
  let t := ((x - Q2R a) / (Q2R b - Q2R a))%R in valuesq (1 - t) t (turnedf g a b) = turned (rg g) x.
Proof.
  intros g a b x G AB X t. unfold valuesq, turnedf, turned, t. cbn [qw qx qy qz rg starts ends turns].
  rewrite !parts_value, !map_map by assumption. reflexivity.
Qed.

(* What is bounded in the body's frame is so where it is. *)
Lemma placed_below : forall q n a l, (0 < square q)%R -> (dot (mul (turn (rotation q)) n) a <= l * square q)%R ->
  (dot n (scale (/ square q) (mul (rotation q) a)) <= l)%R.
Proof.
  intros q n a l P H. rewrite dot_scale, dot_mul. apply (Rmult_le_reg_l (square q)); [exact P|].
  rewrite <- Rmult_assoc, Rinv_r by lra. lra.
Qed.

Lemma near_below : forall r h n len, (0 <= len)%R -> (dot n n <= len * len)%R -> (0 <= r)%R -> near r h -> (dot n h <= r * len)%R.
Proof.
  intros r h n len L N R0 H. unfold near in H. pose proof (cauchy n h). pose proof (dot_self n). pose proof (dot_self h).
  apply square_le; [apply Rmult_le_pos; assumption|].
  assert (dot n n * dot h h <= len * len * (r * r))%R by (apply Rmult_le_compat; assumption). lra.
Qed.

(* One pair of pieces of two bodies while they are on two segments. *)
Definition apart_at (d ra rb : R) (a b : convex R) (f g : segment R) (t : R) : Prop :=
  (0 < square (turned f t))%R /\ (0 < square (turned g t))%R /\
  forall p q x y, inside a p -> inside b q -> near ra (sub x (placed f t p)) -> near rb (sub y (placed g t q)) ->
    (d * d < dot (sub x y) (sub x y))%R.

Lemma plane_apart_real : forall d ra rb A B f g a b p, plane_apart d ra rb A B f g a b p = true ->
  (0 <= Q2R d)%R -> (0 <= Q2R ra)%R -> (0 <= Q2R rb)%R -> (Q2R a < Q2R b)%R ->
  forall ca cb t, In ca A -> In cb B -> (Q2R a <= t <= Q2R b)%R ->
  apart_at (Q2R d) (Q2R ra) (Q2R rb) (rc (snd ca)) (rc (snd cb)) (rg f) (rg g) t.
Proof.
  intros d ra rb A B f g a b p H D0 Ra Rb AB ca cb t IA IB T. unfold plane_apart in H. cbv zeta in H.
  repeat match goal with K : (_ && _)%bool = true |- _ => apply andb_prop in K; destruct K end.
  repeat match goal with K : le _ _ = true |- _ => apply le_real in K end.
  rewrite forallb_forall in *.
  set (u := ((t - Q2R a) / (Q2R b - Q2R a))%R).
  assert (U : (0 <= u <= 1)%R).
  { unfold u. split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|].
    apply (Rmult_le_reg_r (Q2R b - Q2R a)); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (One : (1 - u + u = 1)%R) by ring. assert (S0 : (0 <= 1 - u)%R) by lra. assert (U0 : (0 <= u)%R) by lra.
  assert (F : (Q2R (starts f) < Q2R (ends f))%R) by lra. assert (G : (Q2R (starts g) < Q2R (ends g))%R) by lra.
  pose proof (turnedf_value f a b t F AB T) as Tf. pose proof (turnedf_value g a b t G AB T) as Tg.
  pose proof (positionf_value f a b t F AB T) as Pf. pose proof (positionf_value g a b t G AB T) as Pg.
  cbv zeta in Tf, Tg, Pf, Pg. fold u in Tf, Tg, Pf, Pg.
  match goal with K : positive (squaref (turnedf f a b)) = true |- _ =>
    apply (positive_value _ _ One S0 U0) in K; rewrite squaref_value, Tf in K by assumption; rename K into Qf end.
  match goal with K : positive (squaref (turnedf g a b)) = true |- _ =>
    apply (positive_value _ _ One S0 U0) in K; rewrite squaref_value, Tg in K by assumption; rename K into Qg end.
  match goal with K : positive _ = true |- _ => apply (positive_value _ _ One S0 U0) in K; rename K into Gap end.
  rewrite !minus_value, !dotf_value, !sum_value, Pf, Pg in Gap by assumption.
  set (la := value (of_bernstein (at_most_a p)) (1 - u) u) in *.
  set (lb := value (of_bernstein (at_most_b p)) (1 - u) u) in *.
  assert (Ec : value [(ra + rb + d) * its_length p] (1 - u) u = ((Q2R ra + Q2R rb + Q2R d) * Q2R (its_length p))%R).
  { unfold value. cbn. rewrite Q2R_mult, !Q2R_plus. ring. }
  rewrite Ec in Gap.
  split; [exact Qf|]. split; [exact Qg|]. intros x y X Y IX IY NX NY.
  match goal with K : forall c, In c A -> _ |- _ => pose proof (reach_form_real _ _ One S0 U0 _ _ _ (K _ IA) _ IX) as La end.
  match goal with K : forall c, In c B -> _ |- _ => pose proof (reach_form_real _ _ One S0 U0 _ _ _ (K _ IB) _ IY) as Lb end.
  rewrite unturn_value, product_value, squaref_value, Tf in La by assumption.
  rewrite unturn_value, product_value, squaref_value, Tg, rv_opp in Lb by assumption. fold la in La. fold lb in Lb.
  apply placed_below in La; [|exact Qf]. apply placed_below in Lb; [|exact Qg].
  set (n := rv (its_normal p)) in *. set (len := Q2R (its_length p)) in *.
  match goal with K : (Q2R (dotq _ _) <= _)%R |- _ => rewrite Q2R_dot, Q2R_mult in K; fold n len in K; rename K into Len end.
  match goal with K : (Q2R 0 <= len)%R |- _ => rewrite Q2R_zero in K; rename K into Len0 end.
  pose proof (near_below _ _ n len Len0 Len Ra NX) as Ha.
  assert (LenO : (dot (opp n) (opp n) <= len * len)%R) by (replace (dot (opp n) (opp n)) with (dot n n) by (clear; veq); exact Len).
  pose proof (near_below _ _ (opp n) len Len0 LenO Rb NY) as Hb.
  unfold placed in Ha, Hb. rewrite dot_sub, dot_add in Ha, Hb. rewrite !dot_opp in Hb. rewrite dot_opp in Lb.
  assert (Far : (Q2R d * len < - dot n (sub X Y))%R) by (rewrite dot_sub; lra).
  pose proof (cauchy n (sub X Y)) as C. pose proof (dot_self n). pose proof (dot_self (sub X Y)).
  destruct (Rlt_dec (Q2R d * Q2R d) (dot (sub X Y) (sub X Y))) as [?|N]; [assumption|]. exfalso.
  assert (dot n n * dot (sub X Y) (sub X Y) <= len * len * (Q2R d * Q2R d))%R by (apply Rmult_le_compat; lra).
  assert (- dot n (sub X Y) <= Q2R d * len)%R; [|lra].
  apply square_le; [apply Rmult_le_pos; assumption|]. lra.
Qed.

(* Each time of a stretch is in a piece that shares more than an instant with the stretch. *)
Lemma pieces_cover : forall d P R A B to ps a, pieces_apart d P R A B a to ps = true ->
  forall u v t, (Q2R a <= u)%R -> (u < v)%R -> (v <= Q2R to)%R -> (u <= t <= v)%R ->
  exists x y p, stretch d P R A B x y p = true /\ (Q2R x < Q2R y)%R /\ (Q2R x <= t <= Q2R y)%R /\ (u < Q2R y)%R /\ (Q2R x < v)%R.
Proof.
  intros d P R A B to. induction ps as [|[b p] ps IH]; intros a H u v t U UV V T; cbn [pieces_apart] in H.
  - apply eq_real in H. lra.
  - apply andb_prop in H. destruct H as [H Rest]. apply andb_prop in H. destruct H as [AB St].
    assert (AB' := lt_real _ _ AB).
    destruct (Rlt_dec u (Q2R b)) as [UB|UB].
    + destruct (Rle_dec t (Q2R b)) as [TB|TB].
      * exists a, b, p. repeat split; try assumption; lra.
      * destruct (IH b Rest (Q2R b) v t) as (x & y & q & S1 & S2 & S3 & S4 & S5); try lra.
        exists x, y, q. repeat split; try assumption; lra.
    + apply (IH b Rest u v t); lra.
Qed.

(* Some of a stretch, with the time t in it, is within the time of one of the proofs. *)
Lemma in_turn_some : forall chk to cuts proofs a, in_turn chk a to cuts proofs = true ->
  forall u v t, (Q2R a <= u)%R -> (u < v)%R -> (v <= Q2R to)%R -> (u <= t <= v)%R ->
  exists x y p u' v', chk x y p = true /\ (Q2R x <= u')%R /\ (u' < v')%R /\ (v' <= Q2R y)%R /\ (u' <= t <= v')%R /\
    (u <= u')%R /\ (v' <= v)%R.
Proof.
  intros chk to. induction cuts as [|c cuts IH]; intros [|p proofs] a H u v t U UV V T; try discriminate H.
  - destruct proofs; [|discriminate H]. exists a, to, p, u, v. repeat split; try assumption; lra.
  - cbn [in_turn] in H. apply andb_prop in H. destruct H as [H Rest]. apply andb_prop in H. destruct H as [_ K].
    destruct (Rlt_dec u (Q2R c)) as [UC|UC].
    + destruct (Rle_dec t (Q2R c)) as [TC|TC].
      * exists a, c, p, u, (Rmin v (Q2R c)). unfold Rmin. destruct (Rle_dec v (Q2R c)); repeat split; try assumption; lra.
      * destruct (IH _ _ Rest (Q2R c) v t) as (x & y & q & u' & v' & S1 & S2 & S3 & S4 & S5 & S6 & S7); try lra.
        exists x, y, q, u', v'. repeat split; try assumption; lra.
    + apply (IH _ _ Rest u v t); lra.
Qed.

Lemma check_run_real : forall fuel d from to P R A B p, check_run fuel d from to P R A B p = true ->
  (0 <= Q2R d)%R -> (0 <= Q2R (radius P))%R -> (0 <= Q2R (radius R))%R ->
  forall ca cb f g u v t, In ca A -> In cb B -> In f (track P) -> In g (track R) ->
  (Q2R from <= u)%R -> (u < v)%R -> (v <= Q2R to)%R -> (u <= t <= v)%R ->
  (Q2R (starts f) <= u)%R -> (v <= Q2R (ends f))%R -> (Q2R (starts g) <= u)%R -> (v <= Q2R (ends g))%R ->
  apart_at (Q2R d) (Q2R (radius P)) (Q2R (radius R)) (rc (snd ca)) (rc (snd cb)) (rg f) (rg g) t.
Proof.
  induction fuel as [|fuel IH]; intros d from to P R A B p H D0 Rp Rr ca cb f g u v t IA IB If Ig U UV V T F1 F2 G1 G2;
    [discriminate H|].
  destruct p as [first ps|[] runs proofs|cuts proofs|[] boxes runs p]; cbn [check_run] in H.
  - apply andb_prop in H. destruct H as [_ H].
    destruct (pieces_cover _ _ _ _ _ _ _ _ H u v t U UV V T) as (x & y & p & St & XY & XT & UY & XV).
    unfold stretch in St. rewrite forallb_forall in St.
    assert (Meets : forall h : segment Q, (Q2R (starts h) <= u)%R -> (v <= Q2R (ends h))%R -> meets_time x y h = true).
    { intros h H1 H2. unfold meets_time, lt. apply andb_true_intro. split; apply negb_true_iff.
      - destruct (Qle_bool y (starts h)) eqn:E; [|reflexivity]. apply le_real in E. lra.
      - destruct (Qle_bool (ends h) x) eqn:E; [|reflexivity]. apply le_real in E. lra. }
    specialize (St f (proj2 (filter_In _ _ _) (conj If (Meets f F1 F2)))). rewrite forallb_forall in St.
    specialize (St g (proj2 (filter_In _ _ _) (conj Ig (Meets g G1 G2)))).
    apply (plane_apart_real _ _ _ _ _ _ _ _ _ _ St D0 Rp Rr XY ca cb t IA IB XT).
  - destruct (in_groups_all _ _ _ _ _ ca H IA) as (s & p & X & _ & F).
    apply (IH _ _ _ _ _ _ _ _ F D0 Rp Rr ca cb f g u v t X IB If Ig U UV V T F1 F2 G1 G2).
  - destruct (in_groups_all _ _ _ _ _ cb H IB) as (s & p & X & _ & F).
    apply (IH _ _ _ _ _ _ _ _ F D0 Rp Rr ca cb f g u v t IA X If Ig U UV V T F1 F2 G1 G2).
  - destruct (in_turn_some _ _ _ _ _ H u v t U UV V T) as (x & y & p & u' & v' & K & X & U' & Y & T' & L & L').
    apply (IH _ _ _ _ _ _ _ _ K D0 Rp Rr ca cb f g u' v' t IA IB If Ig X U' Y T'); lra.
  - apply andb_prop in H. destruct H as [H K]. destruct (covered_real _ _ _ _ H IA) as (k & Ik & S).
    destruct (IH _ _ _ _ _ _ _ _ K D0 Rp Rr k cb f g u v t Ik IB If Ig U UV V T F1 F2 G1 G2) as (Q1 & Q2 & Far).
    split; [exact Q1|]. split; [exact Q2|]. intros p' q x y Ip. apply Far, S, Ip.
  - apply andb_prop in H. destruct H as [H K]. destruct (covered_real _ _ _ _ H IB) as (k & Ik & S).
    destruct (IH _ _ _ _ _ _ _ _ K D0 Rp Rr ca k f g u v t IA Ik If Ig U UV V T F1 F2 G1 G2) as (Q1 & Q2 & Far).
    split; [exact Q1|]. split; [exact Q2|]. intros p' q x y Ip Iq. apply (Far p' q x y Ip (S _ Iq)).
Qed.

Theorem check_apart_sound : forall d from to P R p, check_apart d from to P R p = true ->
  apart (Q2R d) (Q2R from) (Q2R to) (rr P) (rr R).
Proof.
  intros d from to P R p H. unfold check_apart in H.
  apply andb_prop in H. destruct H as [H K]. apply andb_prop in H. destruct H as [H WR].
  apply andb_prop in H. destruct H as [H WP]. apply andb_prop in H. destruct H as [D0 _].
  apply le_real in D0. rewrite Q2R_zero in D0.
  assert (Well : forall r, well_formed_runner from to r = true -> (0 <= Q2R (radius r))%R /\ exists c, In c (numbered 0 (its_body r))).
  { intros r W. unfold well_formed_runner in W. apply andb_prop in W. destruct W as [W _]. apply andb_prop in W.
    destruct W as [F L]. apply le_real in L. rewrite Q2R_zero in L. split; [exact L|].
    destruct (its_body r) as [|c b]; [discriminate F|]. exists (0%Z, c). left. reflexivity. }
  destruct (Well _ WP) as [Rp [cp Cp]]. destruct (Well _ WR) as [Rr [cr Cr]].
  generalize dependent depth. intros fuel K f g u v t If Ig U UV V T F1 F2 G1 G2.
  cbn [rr track] in If, Ig. apply in_map_iff in If, Ig. destruct If as (f' & <- & If). destruct Ig as (g' & <- & Ig).
  cbn [rg starts ends] in F1, F2, G1, G2.
  pose proof (check_run_real _ _ _ _ _ _ _ _ _ K D0 Rp Rr) as Check.
  destruct (Check cp cr f' g' u v t Cp Cr If Ig U UV V T F1 F2 G1 G2) as (Q1 & Q2 & _).
  split; [exact Q1|]. split; [exact Q2|]. intros a b x y (ca & Ia & Xa) (cb & Ib & Xb) Na Nb.
  cbn [rr its_body radius] in Ia, Ib, Na, Nb. apply of_numbered in Ia, Ib.
  destruct Ia as (na & Ia & ->). destruct Ib as (nb & Ib & ->).
  destruct (Check na nb f' g' u v t Ia Ib If Ig U UV V T F1 F2 G1 G2) as (_ & _ & Far).
  exact (Far a b x y Xa Xb Na Nb).
Qed.

(* A run: bodies on their tracks, and the pairs of which it is claimed. *)
Record run_claim := Run { by_more_than : Q; start : Q; finish : Q; runners : list (runner Q); pairs : list (Z * Z) }.
Definition meaning_run (c : run_claim) : Prop :=
  forall i j, In (i, j) (pairs c) -> exists A B, nthq (runners c) i = Some A /\ nthq (runners c) j = Some B /\
    apart (Q2R (by_more_than c)) (Q2R (start c)) (Q2R (finish c)) (rr A) (rr B).

Fixpoint check_pairs (c : run_claim) (ps : list (Z * Z)) (proofs : list run_proof) : bool :=
  match ps, proofs with
  | [], [] => true
  | (i, j) :: ps, p :: proofs =>
      match nthq (runners c) i, nthq (runners c) j with
      | Some A, Some B => check_apart (by_more_than c) (start c) (finish c) A B p
      | _, _ => false
      end && check_pairs c ps proofs
  | _, _ => false
  end.
Definition check_run_claim (c : run_claim) (proofs : list run_proof) : bool := check_pairs c (pairs c) proofs.

Theorem check_run_sound : forall c proofs, check_run_claim c proofs = true -> meaning_run c.
Proof.
  intros c proofs H i j I. unfold check_run_claim in H. revert proofs H I.
  induction (pairs c) as [|[k l] ps IH]; intros proofs H I; [destruct I|].
  destruct proofs as [|p proofs]; [discriminate H|]. cbn [check_pairs] in H. apply andb_prop in H. destruct H as [H R].
  destruct I as [E|I]; [|apply (IH _ R I)]. injection E as -> ->.
  destruct (nthq (runners c) i) as [A|]; [|discriminate H]. destruct (nthq (runners c) j) as [B|]; [|discriminate H].
  exists A, B. repeat (split; [reflexivity|]). apply (check_apart_sound _ _ _ _ _ _ H).
Qed.
