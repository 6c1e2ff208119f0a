(* That two bodies within their tubes come as near as d at a time, or meet: d = 0. *)
From Vericone Require Export Runs Fits.
Open Scope Q_scope.

(* At some time in [from, to], each on a segment of its track, a point of each is not farther apart than d from one of
   the other, wherever the two are within the radii. *)
Definition close (d from to : R) (A B : runner R) : Prop :=
  exists t f g a b, (from <= t <= to)%R /\ In f (track A) /\ In g (track B) /\
    (starts f <= t <= ends f)%R /\ (starts g <= t <= ends g)%R /\
    (0 < square (turned f t))%R /\ (0 < square (turned g t))%R /\
    within_body (its_body A) a /\ within_body (its_body B) b /\
    forall x y, near (radius A) (sub x (placed f t a)) -> near (radius B) (sub y (placed g t b)) -> near d (sub x y).

Fixpoint powerq (x : Q) (n : nat) : Q := match n with O => 1 | S n => reduced (x * powerq x n) end.
Fixpoint evalq (p : form_q) (s t : Q) : Q :=
  match p with [] => 0 | c :: p => reduced (c * powerq s (length p) + t * evalq p s t) end.
Lemma powerq_real : forall x n, Q2R (powerq x n) = (Q2R x ^ n)%R.
Proof. intros x n; induction n as [|n IH]; cbn; [apply Q2R_one|]. rewrite reduced_value, Q2R_mult, IH. reflexivity. Qed.
Lemma evalq_real : forall p s t, Q2R (evalq p s t) = value p (Q2R s) (Q2R t).
Proof.
  induction p as [|c p IH]; intros s t; [apply Q2R_zero|]. cbn [evalq].
  rewrite reduced_value, Q2R_plus, !Q2R_mult, powerq_real, IH. unfold value. cbn. rewrite map_length. reflexivity.
Qed.

Definition rotationq (q : quaternion Q) : mat Q :=
  let (w, x, y, z) := q in
  Rows (Vec (w*w + x*x - y*y - z*z) (2 * (x*y - w*z)) (2 * (x*z + w*y)))
       (Vec (2 * (x*y + w*z)) (w*w - x*x + y*y - z*z) (2 * (y*z - w*x)))
       (Vec (2 * (x*z - w*y)) (2 * (y*z + w*x)) (w*w - x*x - y*y + z*z)).
Definition rq (q : quaternion Q) : quaternion R := Quaternion (Q2R (qw q)) (Q2R (qx q)) (Q2R (qy q)) (Q2R (qz q)).
Definition squareq (q : quaternion Q) : Q := qw q * qw q + qx q * qx q + qy q * qy q + qz q * qz q.
Lemma Q2R_two : Q2R 2 = 2%R. Proof. unfold Q2R; cbn; lra. Qed.
Lemma rm_rotation : forall q, rm (rotationq q) = rotation (rq q).
Proof.
  intros [w x y z]. unfold rotationq, rotation, rq, rm, rv. cbn [qw qx qy qz r1 r2 r3 vx vy vz].
  rewrite ?Q2R_plus, ?Q2R_minus, ?Q2R_mult, ?Q2R_plus, ?Q2R_minus, ?Q2R_mult, Q2R_two. reflexivity.
Qed.
Lemma Q2R_square : forall q, Q2R (squareq q) = square (rq q).
Proof. intros q. unfold squareq, square, rq. cbn [qw qx qy qz]. rewrite !Q2R_plus, !Q2R_mult. reflexivity. Qed.

Definition at_time (g : segment Q) (t : Q) (bs : list Q) : Q :=
  let u := reduced ((t - starts g) / (ends g - starts g)) in evalq (of_bernstein bs) (reduced (1 - u)) u.
Definition positionq (g : segment Q) (t : Q) : vec Q :=
  Vec (at_time g t (map vx (positions g))) (at_time g t (map vy (positions g))) (at_time g t (map vz (positions g))).
Definition turnedq (g : segment Q) (t : Q) : quaternion Q :=
  Quaternion (at_time g t (map qw (turns g))) (at_time g t (map qx (turns g)))
             (at_time g t (map qy (turns g))) (at_time g t (map qz (turns g))).
Lemma at_time_real : forall g t bs, (Q2R (starts g) < Q2R (ends g))%R ->
  Q2R (at_time g t bs) = bernstein (map Q2R bs) ((Q2R t - Q2R (starts g)) / (Q2R (ends g) - Q2R (starts g)))%R.
Proof.
  intros g t bs G. unfold at_time. cbv zeta. rewrite evalq_real, <- of_bernstein_value.
  assert (NZ : ~ ends g - starts g == 0).
  { intros E. apply Qeq_eqR in E. rewrite Q2R_minus, Q2R_zero in E. lra. }
  repeat rewrite ?reduced_value, ?Q2R_minus, ?Q2R_one, ?Q2R_div by assumption. reflexivity.
Qed.

(* The point x in the frame of a body. *)
Definition in_frame (g : segment Q) (t : Q) (x : vec Q) : vec Q :=
  let q := turnedq g t in scaleq (/ squareq q) (mulq (turnq (rotationq q)) (subq x (positionq g t))).
Definition has_at (r : runner Q) (t : Q) (x : vec Q) (p : place) : bool :=
  match find (numbered 0 (its_body r)) (piece p) with
  | None => false
  | Some c => existsb (fun g => lt (starts g) (ends g) && le (starts g) t && le t (ends g) && lt 0 (squareq (turnedq g t)) &&
      member false c (weights p) (in_frame g t x)) (track r)
  end.
Lemma turned_around : forall q d, (square q <> 0)%R ->
  scale (/ square q) (mul (rotation q) (scale (/ square q) (mul (turn (rotation q)) d))) = d.
Proof.
  intros q d N.
  assert (E : mul (rotation q) (mul (turn (rotation q)) d) = scale (square q * square q) d).
  { clear N. destruct q as [w x y z]. unfold rotation, square. cbn [qw qx qy qz]. veq. }
  rewrite mul_scale, E. generalize dependent (square q). intros k N _. destruct d. plain. f_equal; field; assumption.
Qed.
Lemma has_at_real : forall r t x p, has_at r t x p = true -> exists g a, In g (track (rr r)) /\
  (starts g <= Q2R t <= ends g)%R /\ (0 < square (turned g (Q2R t)))%R /\ within_body (its_body (rr r)) a /\
  placed g (Q2R t) a = rv x.
Proof.
  intros r t x p H. unfold has_at in H. destruct (find _ (piece p)) as [c|] eqn:F; [|discriminate H].
  apply existsb_exists in H. destruct H as (g & G & H).
  repeat match goal with K : (_ && _)%bool = true |- _ => apply andb_prop in K; destruct K end.
  repeat match goal with K : lt _ _ = true |- _ => apply lt_real in K | K : le _ _ = true |- _ => apply le_real in K end.
  match goal with K : member _ _ _ _ = true |- _ => apply member_inside in K; destruct K as [M _] end.
  match goal with K : (Q2R (starts g) < Q2R (ends g))%R |- _ => rename K into Long end.
  assert (Eq : rq (turnedq g t) = turned (rg g) (Q2R t)).
  { unfold rq, turnedq, turned. cbn [qw qx qy qz rg starts ends turns]. rewrite !at_time_real, !map_map by assumption. reflexivity. }
  assert (Ep : rv (positionq g t) = position (rg g) (Q2R t)).
  { unfold rv, positionq, position. cbn [vx vy vz rg starts ends positions]. rewrite !at_time_real, !map_map by assumption. reflexivity. }
  match goal with K : (Q2R 0 < Q2R (squareq _))%R |- _ => rewrite Q2R_zero, Q2R_square, Eq in K; rename K into Sq end.
  exists (rg g), (rv (in_frame g t x)). split; [apply in_map, G|]. split; [cbn; lra|]. split; [exact Sq|]. split.
  - exists (rc c). split; [|exact M]. apply find_in in F. apply in_map_iff in F. destruct F as ([j d] & <- & F).
    apply in_map, (numbered_in _ _ _ _ _ F).
  - unfold placed, in_frame. cbv zeta.
    assert (NZ : ~ squareq (turnedq g t) == 0).
    { intros E. apply Qeq_eqR in E. rewrite Q2R_square, Eq, Q2R_zero in E. lra. }
    rewrite rv_scale, Q2R_inv, Q2R_square, rv_mul, rm_turn, rm_rotation, rv_sub, Eq, Ep by exact NZ.
    rewrite turned_around by lra. generalize (position (rg g) (Q2R t)) (rv x). clear. veq.
Qed.

(* Where a mean of a piece's corners is at a time: what is found so is checked by has_at. *)
Definition means_at (r : runner Q) (t : Q) (p : place) : list (vec Q) :=
  match find (numbered 0 (its_body r)) (piece p) with
  | None => []
  | Some c =>
      match chosenq (corners c) (weights p) with
      | None => []
      | Some qs =>
          let x := meanq (map snd (weights p)) qs in
          map (fun g => let q := turnedq g t in addq (positionq g t) (scaleq (/ squareq q) (mulq (rotationq q) x)))
            (filter (fun g => lt (starts g) (ends g) && le (starts g) t && le t (ends g)) (track r))
      end
  end.

Lemma near_add : forall r s u v, (0 <= r)%R -> (0 <= s)%R -> near r u -> near s v -> near (r + s) (add u v).
Proof.
  intros r s u v R0 S0 U V. unfold near in *. pose proof (cauchy u v). pose proof (dot_self u). pose proof (dot_self v).
  assert (dot u u * dot v v <= r * r * (s * s))%R by (apply Rmult_le_compat; assumption).
  assert (dot u v <= r * s)%R by (apply square_le; [apply Rmult_le_pos; assumption|lra]).
  replace (dot (add u v) (add u v)) with (dot u u + 2 * dot u v + dot v v)%R by (clear; veq). lra.
Qed.
Lemma near_opp : forall r u, near r u -> near r (opp u).
Proof. intros r u U. unfold near in *. replace (dot (opp u) (opp u)) with (dot u u) by (clear; veq). exact U. Qed.

Definition check_close (d from to : Q) (A B : runner Q) (t : Q) (x y : vec Q) (pa pb : place) : bool :=
  let s := d - radius A - radius B in
  well_formed_runner from to A && well_formed_runner from to B && le from t && le t to &&
  has_at A t x pa && has_at B t y pb && le 0 s && le (dotq (subq x y) (subq x y)) (s * s).
Theorem check_close_sound : forall d from to A B t x y pa pb, check_close d from to A B t x y pa pb = true ->
  close (Q2R d) (Q2R from) (Q2R to) (rr A) (rr B).
Proof.
  intros d from to A B t x y pa pb H. unfold check_close in H. cbv zeta in H.
  apply andb_prop in H. destruct H as [H Short]. apply andb_prop in H. destruct H as [H S0].
  apply andb_prop in H. destruct H as [H HB]. apply andb_prop in H. destruct H as [H HA].
  apply andb_prop in H. destruct H as [H T1]. apply andb_prop in H. destruct H as [H T0].
  apply andb_prop in H. destruct H as [WA WB]. apply le_real in T0, T1, Short, S0.
  assert (Radius : forall r, well_formed_runner from to r = true -> (0 <= Q2R (radius r))%R).
  { intros r W. unfold well_formed_runner in W. apply andb_prop in W. destruct W as [W _]. apply andb_prop in W.
    destruct W as [_ L]. apply le_real in L. rewrite Q2R_zero in L. exact L. }
  apply Radius in WA, WB.
  destruct (has_at_real _ _ _ _ HA) as (f & a & F1 & F2 & F3 & F4 & F5).
  destruct (has_at_real _ _ _ _ HB) as (g & b & G1 & G2 & G3 & G4 & G5).
  exists (Q2R t), f, g, a, b. repeat (split; [auto; lra|]). intros u v U V. rewrite F5 in U. rewrite G5 in V.
  cbn [rr radius] in U, V. rewrite Q2R_zero, !Q2R_minus in S0. rewrite Q2R_dot, rv_sub, Q2R_mult, !Q2R_minus in Short.
  assert (M : near (Q2R d - Q2R (radius A) - Q2R (radius B)) (sub (rv x) (rv y))) by exact Short.
  pose proof (near_add _ _ _ _ WA S0 U M) as N1.
  assert (P1 : (0 <= Q2R (radius A) + (Q2R d - Q2R (radius A) - Q2R (radius B)))%R) by lra.
  pose proof (near_add _ _ _ _ P1 WB N1 (near_opp _ _ V)) as N2.
  replace (Q2R d) with (Q2R (radius A) + (Q2R d - Q2R (radius A) - Q2R (radius B)) + Q2R (radius B))%R by ring.
  replace (sub u v) with (add (add (sub u (rv x)) (sub (rv x) (rv y))) (opp (sub v (rv y)))); [exact N2|].
  generalize (rv x) (rv y). clear. intros x y. veq.
Qed.
