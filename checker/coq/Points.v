(* Points: what proves that a point is in a body, or strictly inside it, and what follows of collisions. *)
From Vericone Require Export Supports.
Open Scope R_scope.

(* A ball about x lies in the body. *)
Definition interior (c : convex R) (x : vec R) : Prop := exists e, 0 < e /\ forall h, near e h -> inside c (add x h).

(* What is small with h. *)
Lemma near_less : forall e f h, 0 <= e <= f -> near e h -> near f h.
Proof. unfold near; intros; nra. Qed.

Lemma near_scale : forall e k h, 0 <= k -> near e h -> near (k * e) (scale k h).
Proof.
  unfold near; intros e k h K N.
  replace (dot (scale k h) (scale k h)) with (k * k * dot h h) by veq.
  replace (k * e * (k * e)) with (k * k * (e * e)) by ring.
  apply Rmult_le_compat_l; nra.
Qed.

Lemma near_opp : forall e h, near e h -> near e (opp h).
Proof. unfold near; intros e h N. replace (dot (opp h) (opp h)) with (dot h h) by veq. assumption. Qed.

Lemma near_dot : forall e g h, 0 <= e -> near e h -> - (e * (dot g g + 1)) <= dot g h <= e * (dot g g + 1).
Proof.
  unfold near; intros e g h E N. pose proof (cauchy g h). pose proof (dot_self g).
  set (q := dot g g) in *. set (y := dot g h) in *. set (s := dot h h) in *.
  assert (q * s <= q * (e * e)) by (apply Rmult_le_compat_l; assumption).
  assert (y * y <= (e * (q + 1)) * (e * (q + 1))).
  { replace (e * (q + 1) * (e * (q + 1))) with (e * e * (q * q + 2 * q + 1)) by ring.
    assert (0 <= e * e) by nra. nra. }
  assert (0 <= e * (q + 1)) by (apply Rmult_le_pos; lra).
  split; [|apply square_le; assumption].
  assert (- y <= e * (q + 1)) by (apply square_le; [assumption|nra]). lra.
Qed.

Lemma small_dot : forall g s, 0 < s -> exists e, 0 < e /\ forall h, near e h -> - s <= dot g h <= s.
Proof.
  intros g s S0. pose proof (dot_self g). exists (s / (dot g g + 1)).
  assert (0 < s / (dot g g + 1)) by (apply Rdiv_lt_0_compat; lra).
  split; [assumption|]. intros h N. pose proof (near_dot _ g h (Rlt_le _ _ H0) N) as B.
  replace (s / (dot g g + 1) * (dot g g + 1)) with s in B by (field; lra). exact B.
Qed.

Lemma both : forall P Q : vec R -> Prop,
  (exists e, 0 < e /\ forall h, near e h -> P h) -> (exists e, 0 < e /\ forall h, near e h -> Q h) ->
  exists e, 0 < e /\ forall h, near e h -> P h /\ Q h.
Proof.
  intros P Q (e & E & HP) (f & F & HQ). exists (Rmin e f). split; [apply Rmin_glb_lt; assumption|].
  assert (0 <= Rmin e f) by (apply Rmin_glb; lra).
  intros h N. split; [apply HP | apply HQ]; eapply near_less; try exact N; split; auto using Rmin_l, Rmin_r.
Qed.

(* What a quadratic form exceeds strictly, it exceeds near by. *)
Lemma form_near : forall M c d, form M d < c -> exists e, 0 < e /\ forall h, near e h -> form M (add d h) <= c.
Proof.
  intros M c d H.
  set (g := add (mul M d) (mul (turn M) d)).
  set (K := dot (r1 M) (r1 M) + dot (r2 M) (r2 M) + dot (r3 M) (r3 M)).
  assert (K0 : 0 <= K).
  { unfold K. pose proof (dot_self (r1 M)). pose proof (dot_self (r2 M)). pose proof (dot_self (r3 M)). lra. }
  pose proof (dot_self g) as G0. set (D := dot g g + 1 + (K + 1)).
  assert (D0 : 2 <= D) by (unfold D; lra).
  set (slack := c - form M d). assert (S0 : 0 < slack) by (unfold slack; lra).
  set (e := slack / (slack + D)).
  assert (E0 : 0 < e) by (apply Rdiv_lt_0_compat; lra).
  assert (E : e * (slack + D) = slack) by (unfold e; field; lra).
  assert (E1 : e <= 1) by nra.
  exists e. split; [assumption|]. intros h N.
  replace (form M (add d h)) with (form M d + dot g h + form M h) by (unfold g; veq).
  assert (B : dot g h <= e * (dot g g + 1)) by (apply near_dot; [lra|assumption]).
  assert (Q : form M h <= e * (K + 1)).
  { unfold near in N. pose proof (dot_self h) as h0.
    assert (MM : dot (mul M h) (mul M h) <= K * dot h h).
    { pose proof (cauchy (r1 M) h). pose proof (cauchy (r2 M) h). pose proof (cauchy (r3 M) h).
      replace (dot (mul M h) (mul M h)) with (dot (r1 M) h * dot (r1 M) h + dot (r2 M) h * dot (r2 M) h
        + dot (r3 M) h * dot (r3 M) h) by reflexivity. unfold K. lra. }
    unfold form. pose proof (cauchy h (mul M h)) as C.
    set (s := dot h h) in *. set (y := dot h (mul M h)) in *. set (m := dot (mul M h) (mul M h)) in *.
    assert (s <= e) by nra.
    assert (s * m <= s * (K * s)) by (apply Rmult_le_compat_l; lra).
    assert (s * s <= e * e) by nra.
    assert (y * y <= (e * (K + 1)) * (e * (K + 1))).
    { replace (e * (K + 1) * (e * (K + 1))) with (e * e * (K * K + 2 * K + 1)) by ring.
      assert (K * (s * s) <= K * (e * e)) by (apply Rmult_le_compat_l; lra).
      assert (0 <= e * e) by nra. nra. }
    apply square_le; [apply Rmult_le_pos; lra|assumption]. }
  assert (e * D <= slack) by nra. unfold D, slack in *. nra.
Qed.

(* Hulls: sums of corners with weights, as a cone. *)
Definition cone (ps : list (vec R)) (k : R) (x : vec R) : Prop :=
  exists ws, length ws = length ps /\ Forall (fun w => 0 <= w) ws /\ total ws = k /\ x = mean ws ps.

Lemma cone_zero : forall ps, cone ps 0 zero.
Proof.
  induction ps as [|p ps (ws & L & W & T & E)].
  - exists []. repeat split; constructor.
  - exists (0 :: ws). repeat split; [cbn; congruence | constructor; [lra|assumption] | cbn; unfold total in T; lra |].
    cbn. rewrite <- E. veq.
Qed.

Lemma cone_one : forall ps k p, 0 <= k -> In p ps -> cone ps k (scale k p).
Proof.
  induction ps as [|q ps IH]; intros k p K H; [destruct H|].
  destruct H as [->|H].
  - destruct (cone_zero ps) as (ws & L & W & T & E). exists (k :: ws).
    repeat split; [cbn; congruence | constructor; assumption | cbn; unfold total in T; lra |].
    cbn. rewrite <- E. veq.
  - destruct (IH k p K H) as (ws & L & W & T & E). exists (0 :: ws).
    repeat split; [cbn; congruence | constructor; [lra|assumption] | cbn; unfold total in T; lra |].
    cbn. rewrite <- E. veq.
Qed.

Lemma cone_add : forall ps k x l y, cone ps k x -> cone ps l y -> cone ps (k + l) (add x y).
Proof.
  induction ps as [|p ps IH]; intros k x l y (ws & L & W & T & E) (us & L' & W' & T' & E').
  - destruct ws; [|discriminate L]. destruct us; [|discriminate L']. exists [].
    cbn in *. subst. repeat split; [constructor | lra | veq].
  - destruct ws as [|w ws]; [discriminate L|]. destruct us as [|u us]; [discriminate L'|].
    cbn in L, L', T, T', E, E'. inversion W; inversion W'; subst.
    destruct (IH (total ws) (mean ws ps) (total us) (mean us ps)) as (vs & LV & V & TV & EV).
    + exists ws. repeat split; [injection L; auto | assumption].
    + exists us. repeat split; [injection L'; auto | assumption].
    + exists ((w + u) :: vs). repeat split; [cbn; congruence | constructor; [lra|assumption] | |].
      * cbn. unfold total in *. lra.
      * cbn. rewrite <- EV. veq.
Qed.

(* Corners qs of ps with weights. *)
Lemma chosen_cone : forall ps qs ws, length ws = length qs -> Forall (fun w => 0 <= w) ws ->
  Forall (fun q => In q ps) qs -> cone ps (total ws) (mean ws qs).
Proof.
  intros ps; induction qs as [|q qs IH]; intros [|w ws] L W I; try discriminate L.
  - apply cone_zero.
  - inversion W; inversion I; subst. cbn. apply cone_add; [apply cone_one; assumption|].
    apply IH; [injection L; auto | assumption | assumption].
Qed.

Lemma chosen_inside : forall ps qs ws, length ws = length qs -> Forall (fun w => 0 <= w) ws -> total ws = 1 ->
  Forall (fun q => In q ps) qs -> inside (Hull ps) (mean ws qs).
Proof. intros ps qs ws L W T I. pose proof (chosen_cone ps qs ws L W I) as H. rewrite T in H. exact H. Qed.

(* Three vectors: coordinates along them, times their determinant. *)
Definition columns (a b c : vec R) := turn (Rows a b c).
Lemma solve : forall a b c h, det (columns a b c) <> 0 ->
  let u := scale (/ det (columns a b c)) (mul (adj (columns a b c)) h) in
  add (scale (vx u) a) (add (scale (vy u) b) (scale (vz u) c)) = h.
Proof.
  intros a b c h D u.
  assert (E : mul (columns a b c) u = h).
  { unfold u. transitivity (scale (/ det (columns a b c)) (mul (columns a b c) (mul (adj (columns a b c)) h))).
    - apply mul_scale.
    - rewrite mul_adj. generalize dependent (det (columns a b c)). intros k K. open_vec. plain. f_equal; field; assumption. }
  transitivity (mul (columns a b c) u); [|exact E]. unfold columns. generalize u. veq.
Qed.

(* The three coordinates are small with h. *)
Lemma solve_small : forall a b c s, det (columns a b c) <> 0 -> 0 < s ->
  exists e, 0 < e /\ forall h, near e h -> exists u v w, - s <= u <= s /\ - s <= v <= s /\ - s <= w <= s /\
    add (scale u a) (add (scale v b) (scale w c)) = h.
Proof.
  intros a b c s D S0. set (k := / det (columns a b c)). set (A := adj (columns a b c)).
  destruct (both _ _ (small_dot (scale k (r1 A)) s S0) (both _ _ (small_dot (scale k (r2 A)) s S0)
    (small_dot (scale k (r3 A)) s S0))) as (e & E & H).
  exists e. split; [assumption|]. intros h N. destruct (H h N) as (U & V & W).
  exists (dot (scale k (r1 A)) h), (dot (scale k (r2 A)) h), (dot (scale k (r3 A)) h).
  repeat (split; [assumption|]).
  transitivity (let u := scale k (mul A h) in add (scale (vx u) a) (add (scale (vy u) b) (scale (vz u) c)));
    [|apply solve; assumption].
  generalize k A. veq.
Qed.

(* Symmetric and positive: by its leading minors. *)
Definition positive_shape (M : mat R) : Prop :=
  vy (r1 M) = vx (r2 M) /\ vz (r1 M) = vx (r3 M) /\ vz (r2 M) = vy (r3 M) /\
  0 < vx (r1 M) /\ 0 < vx (r1 M) * vy (r2 M) - vy (r1 M) * vy (r1 M) /\ 0 < det M.

Lemma positive_form : forall M n, positive_shape M -> 0 <= form M n.
Proof.
  intros [[a b c] [b' d f] [c' f' g]] [x y z] (E1 & E2 & E3 & A & B & D). cbn [vx vy vz r1 r2 r3] in *. subst b' c' f'.
  set (m := a * d - b * b) in *.
  assert (E : a * m * form (Rows (Vec a b c) (Vec b d f) (Vec c f g)) (Vec x y z)
    = m * ((a * x + b * y + c * z) * (a * x + b * y + c * z))
      + (m * y + (a * f - b * c) * z) * (m * y + (a * f - b * c) * z)
      + a * (det (Rows (Vec a b c) (Vec b d f) (Vec c f g)) * (z * z))).
  { unfold m. plain. ring. }
  assert (0 <= a * m * form (Rows (Vec a b c) (Vec b d f) (Vec c f g)) (Vec x y z)).
  { rewrite E. apply Rplus_le_le_0_compat; [apply Rplus_le_le_0_compat|].
    - apply Rmult_le_pos; [unfold m in *; lra|apply square_pos].
    - apply square_pos.
    - apply Rmult_le_pos; [lra|]. apply Rmult_le_pos; [lra|apply square_pos]. }
  assert (0 < a * m) by (apply Rmult_lt_0_compat; assumption).
  destruct (Rle_dec 0 (form (Rows (Vec a b c) (Vec b d f) (Vec c f g)) (Vec x y z))); [assumption|nra].
Qed.

Lemma shape_cauchy : forall M n m, positive_shape M ->
  dot n (mul M m) * dot n (mul M m) <= form M n * form M m.
Proof.
  intros M n m P.
  assert (S1 : forall u v, dot u (mul M v) = dot v (mul M u)).
  { destruct M as [[a b c] [b' d f] [c' f' g]]. destruct P as (E1 & E2 & E3 & _). cbn [vx vy vz r1 r2 r3] in *. subst. veq. }
  pose proof (positive_form M n P) as N. pose proof (positive_form M m P) as Q.
  set (k := dot n (mul M m)).
  assert (F : forall s t, 0 <= s * s * form M n + 2 * (s * t) * k + t * t * form M m).
  { intros s t. pose proof (positive_form M (add (scale s n) (scale t m)) P) as H.
    replace (form M (add (scale s n) (scale t m)))
      with (s * s * form M n + s * t * (dot n (mul M m) + dot m (mul M n)) + t * t * form M m) in H by veq.
    rewrite (S1 m n) in H. fold k in H. lra. }
  destruct (Req_dec (form M m) 0) as [Z|Z].
  - rewrite Z in *. pose proof (F k (- (form M n + 1))) as G.
    assert (k * k * form M n + 2 * (k * - (form M n + 1)) * k = - (k * k) * (form M n + 2)) by ring.
    assert (0 <= k * k) by nra. nra.
  - pose proof (F (form M m) (- k)) as G.
    assert (0 <= form M m * (form M n * form M m - k * k)) by nra.
    assert (0 < form M m) by lra. nra.
Qed.

(* Weights that change little: sums of ds that make h. *)
Definition little (m u : R) := - m <= u <= m.
Definition combines (ds : list (vec R)) (m : R) (h : vec R) : Prop :=
  exists us, length us = length ds /\ Forall (little m) us /\ little m (total us) /\ mean us ds = h.

Lemma combines_zero : forall ds m, 0 <= m -> combines ds m zero.
Proof.
  unfold combines, little. induction ds as [|d ds IH]; intros m M.
  - exists []. cbn. split; [reflexivity|]. split; [constructor|]. split; [lra|reflexivity].
  - destruct (IH m M) as (us & L & U & T & E). exists (0 :: us). cbn. unfold total in *.
    repeat split; [congruence | constructor; [lra|assumption] | lra | lra | rewrite E; veq].
Qed.

Lemma combines_one : forall ds m u d, little m u -> In d ds -> combines ds m (scale u d).
Proof.
  unfold combines, little. induction ds as [|c ds IH]; intros m u d U I; [destruct I|].
  destruct I as [->|I].
  - destruct (combines_zero ds 0 (Rle_refl 0)) as (us & L & V & T & E). unfold little in *.
    exists (u :: us). cbn. unfold total in *.
    repeat split; [congruence | constructor; [lra|] | lra | lra | rewrite E; veq].
    eapply Forall_impl; [|exact V]. cbn. intros. lra.
  - destruct (IH m u d U I) as (us & L & V & T & E). exists (0 :: us). cbn. unfold total in *.
    repeat split; [congruence | constructor; [lra|assumption] | lra | lra | rewrite E; veq].
Qed.

Lemma combines_add : forall ds m g l h, combines ds m g -> combines ds l h -> combines ds (m + l) (add g h).
Proof.
  unfold combines, little. induction ds as [|d ds IH]; intros m g l h (us & L & U & T & E) (vs & L' & V & T' & E').
  - exists []. destruct us; [|discriminate L]. destruct vs; [|discriminate L']. cbn in *. subst.
    repeat split; [constructor | lra | lra | veq].
  - destruct us as [|u us]; [discriminate L|]. destruct vs as [|v vs]; [discriminate L'|].
    inversion U; inversion V; subst.
    exists (map (fun p => fst p + snd p) (combine (u :: us) (v :: vs))).
    assert (G : forall ds us vs, length us = length ds -> length vs = length ds ->
      Forall (little m) us -> Forall (little l) vs ->
      let ws := map (fun p => fst p + snd p) (combine us vs) in
      length ws = length ds /\ Forall (little (m + l)) ws /\ total ws = total us + total vs
      /\ mean ws ds = add (mean us ds) (mean vs ds)).
    { clear. unfold little. induction ds as [|d ds IH]; intros [|u us] [|v vs] L L' U V; try discriminate.
      - cbn. repeat split; [constructor | lra | veq].
      - inversion U; inversion V; subst.
        destruct (IH us vs) as (A & B & C & D); [injection L; auto | injection L'; auto | assumption | assumption |].
        cbn in *. unfold total in *. cbn. repeat split; [congruence | constructor; [lra|assumption] | lra |].
        rewrite D. veq. }
    destruct (G (d :: ds) (u :: us) (v :: vs) L L' U V) as (A & B & C & D).
    repeat split; [assumption | exact B | | | exact D]; rewrite C; lra.
Qed.

(* Some three of them are in no plane through the origin. *)
Definition spread (ds : list (vec R)) : Prop :=
  exists a b c, In a ds /\ In b ds /\ In c ds /\ det (columns a b c) <> 0.

Lemma spread_combines : forall ds m, spread ds -> 0 < m -> exists e, 0 < e /\ forall h, near e h -> combines ds m h.
Proof.
  intros ds m (a & b & c & A & B & C & D) M.
  destruct (solve_small a b c (m / 3) D) as (e & E & N); [lra|].
  exists e. split; [assumption|]. intros h I. destruct (N h I) as (u & v & w & U & V & W & <-).
  replace m with (m / 3 + (m / 3 + m / 3)) by field.
  repeat apply combines_add; apply combines_one; assumption.
Qed.

(* The same with weights of sum 0. *)
Lemma mean_sub : forall ds us d, length us = length ds ->
  mean us (map (fun c => sub c d) ds) = sub (mean us ds) (scale (total us) d).
Proof.
  induction ds as [|c ds IH]; intros [|u us] d L; try discriminate L.
  - cbn. veq.
  - cbn. rewrite IH by (injection L; auto). unfold total. generalize (mean us ds). generalize (fold_right Rplus 0 us). veq.
Qed.

Lemma spread_affine : forall d ds m, spread (map (fun c => sub c d) ds) -> 0 < m ->
  exists e, 0 < e /\ forall h, near e h ->
  exists us, length us = length (d :: ds) /\ Forall (little m) us /\ total us = 0 /\ mean us (d :: ds) = h.
Proof.
  intros d ds m S M. destruct (spread_combines _ m S M) as (e & E & N).
  exists e. split; [assumption|]. intros h I. destruct (N h I) as (us & L & U & T & H).
  rewrite map_length in L. rewrite mean_sub in H by assumption.
  exists (- total us :: us). unfold little in *. cbn. repeat split; [congruence | constructor; [lra|assumption] | |].
  - fold (total us). ring.
  - rewrite <- H. generalize (mean us ds). generalize (total us). veq.
Qed.

(* Positive weights bear a little. *)
Lemma least_weight : forall ws, Forall (fun w => 0 < w) ws -> exists m, 0 < m /\ Forall (fun w => m <= w) ws.
Proof.
  induction ws as [|w ws IH]; intros F.
  - exists 1. split; [lra|constructor].
  - inversion F; subst. destruct (IH H2) as (m & M & G). exists (Rmin w m).
    split; [apply Rmin_glb_lt; assumption|]. constructor; [apply Rmin_l|].
    eapply Forall_impl; [|exact G]. cbn. intros a A. pose proof (Rmin_r w m). lra.
Qed.

Definition sums (ws us : list R) := map (fun p => fst p + snd p) (combine ws us).
Lemma sums_total : forall ws us, length us = length ws -> total (sums ws us) = total ws + total us.
Proof.
  induction ws as [|w ws IH]; intros [|u us] L; try discriminate L; [cbn; lra|].
  specialize (IH us (f_equal pred L)). unfold total, sums in *. cbn in *. lra.
Qed.
Lemma sums_length : forall ws us, length us = length ws -> length (sums ws us) = length ws.
Proof. intros ws us L. unfold sums. rewrite map_length, combine_length, L. apply PeanoNat.Nat.min_id. Qed.
Lemma sums_mean : forall ds ws us, length us = length ws -> length ws = length ds ->
  mean (sums ws us) ds = add (mean ws ds) (mean us ds).
Proof.
  induction ds as [|d ds IH]; intros [|w ws] [|u us] L L'; try discriminate; try (cbn; veq).
  specialize (IH ws us (f_equal pred L) (f_equal pred L')). unfold sums in *. cbn in *. rewrite IH. veq.
Qed.
Lemma sums_least : forall l m ws us, length us = length ws -> Forall (fun w => l <= w) ws -> Forall (little m) us ->
  Forall (fun w => l - m <= w) (sums ws us).
Proof.
  unfold little. induction ws as [|w ws IH]; intros [|u us] L W U; try discriminate L; [constructor|].
  inversion W; inversion U; subst. constructor; [cbn; lra|]. apply IH; [injection L; auto | assumption | assumption].
Qed.

(* What is checked of a point: holds and deep, from the point's place in the body or, of hulls, corners qs with
   weights ws. *)
Definition holds (c : convex R) (ws : list R) (qs : list (vec R)) (x : vec R) : Prop :=
  match c with
  | Ellipsoid p F => det F <> 0 /\
      dot (mul (adj F) (sub x p)) (mul (adj F) (sub x p)) <= det F * det F
  | Shaped p M => positive_shape M /\ form (adj M) (sub x p) <= det M
  | Ball p r => 0 <= r /\ dot (sub x p) (sub x p) <= r * r
  | Box lo hi => vx lo <= vx x <= vx hi /\ vy lo <= vy x <= vy hi /\ vz lo <= vz x <= vz hi
  | Hull ps => length ws = length qs /\ Forall (fun w => 0 < w) ws /\ Forall (fun q => In q ps) qs /\
      total ws = 1 /\ x = mean ws qs
  | Cut _ _ _ _ => False
  end.

Definition deep (c : convex R) (ws : list R) (qs : list (vec R)) (x : vec R) : Prop :=
  match c with
  | Ellipsoid p F => det F <> 0 /\
      dot (mul (adj F) (sub x p)) (mul (adj F) (sub x p)) < det F * det F
  | Shaped p M => positive_shape M /\ form (adj M) (sub x p) < det M
  | Ball p r => 0 <= r /\ dot (sub x p) (sub x p) < r * r
  | Box lo hi => vx lo < vx x < vx hi /\ vy lo < vy x < vy hi /\ vz lo < vz x < vz hi
  | Hull _ => holds c ws qs x /\
      match qs with q :: qs => spread (map (fun c => sub c q) qs) | [] => False end
  | Cut _ _ _ _ => False
  end.

Lemma ellipsoid_inside : forall p F x, det F <> 0 ->
  dot (mul (adj F) (sub x p)) (mul (adj F) (sub x p)) <= det F * det F -> inside (Ellipsoid p F) x.
Proof.
  intros p F x D H. exists (scale (/ det F) (mul (adj F) (sub x p))). split.
  - set (m := mul (adj F) (sub x p)) in *.
    replace (dot (scale (/ det F) m) (scale (/ det F) m)) with (/ (det F * det F) * dot m m).
    + assert (0 < det F * det F) by nra. apply (Rmult_le_reg_l (det F * det F)); [assumption|].
      rewrite <- Rmult_assoc, Rinv_r by lra. lra.
    + rewrite Rinv_mult. generalize (/ det F). veq.
  - transitivity (add p (scale (/ det F) (mul F (mul (adj F) (sub x p))))).
    + rewrite mul_adj. generalize dependent (det F). intros. open_vec. plain. f_equal; field; assumption.
    + generalize (/ det F). generalize (mul (adj F) (sub x p)). veq.
Qed.

Lemma shape_inside : forall p M x, positive_shape M -> form (adj M) (sub x p) <= det M -> inside (Shaped p M) x.
Proof.
  intros p M x P H n. set (d := sub x p) in *. set (m := mul (adj M) d).
  pose proof (shape_cauchy M n m P) as C. unfold m in C at 1 2. rewrite mul_adj, dot_scale in C.
  assert (Q : form M m = det M * form (adj M) d).
  { unfold form at 1. unfold m at 2. rewrite mul_adj, dot_scale. unfold form, m. rewrite dot_sym. reflexivity. }
  rewrite Q in C. pose proof (positive_form M n P) as N.
  assert (D : 0 < det M) by (destruct P as (_ & _ & _ & _ & _ & D); exact D).
  set (k := dot n d) in *. set (D' := det M) in *. set (f := form (adj M) d) in *. set (q := form M n) in *.
  assert (D' * (D' * (k * k)) <= D' * (q * f)) by lra.
  assert (D' * (k * k) <= q * f) by (apply (Rmult_le_reg_l D'); assumption).
  assert (q * f <= q * D') by (apply Rmult_le_compat_l; assumption).
  apply (Rmult_le_reg_l D'); [assumption|]. lra.
Qed.

Lemma positive_weights : forall ws, Forall (fun w => 0 < w) ws -> Forall (fun w => 0 <= w) ws.
Proof. intros ws. apply Forall_impl. cbn. intros. lra. Qed.

Lemma holds_inside : forall c ws qs x, holds c ws qs x -> inside c x.
Proof.
  intros [p F|p M|p r|lo hi|ps|c p A l] ws qs x H; cbn [holds] in H; [..|contradiction].
  - destruct H. apply ellipsoid_inside; assumption.
  - destruct H. apply shape_inside; assumption.
  - exact H.
  - exact H.
  - destruct H as (L & W & I & T & ->). apply chosen_inside; try assumption. apply positive_weights; assumption.
Qed.

Lemma between_near : forall lo x hi g, lo < x < hi ->
  exists e, 0 < e /\ forall h, near e h -> lo <= x + dot g h <= hi.
Proof.
  intros lo x hi g [L H].
  destruct (small_dot g (Rmin (x - lo) (hi - x))) as (e & E & N); [apply Rmin_glb_lt; lra|].
  exists e. split; [assumption|]. intros h I. specialize (N h I).
  pose proof (Rmin_l (x - lo) (hi - x)). pose proof (Rmin_r (x - lo) (hi - x)). lra.
Qed.

Lemma sub_add : forall x h p, sub (add x h) p = add (sub x p) h. Proof. veq. Qed.

Definition gram (A : mat R) := (* A^T A *)
  let B := turn A in Rows (mul B (r1 B)) (mul B (r2 B)) (mul B (r3 B)).
Lemma gram_form : forall A d, form (gram A) d = dot (mul A d) (mul A d).
Proof. unfold gram. veq. Qed.

Definition unit_shape : mat R := Rows (Vec 1 0 0) (Vec 0 1 0) (Vec 0 0 1).
Lemma unit_form : forall d, form unit_shape d = dot d d.
Proof. unfold unit_shape. veq. Qed.

(* Weights may change a little. *)
Lemma hull_deep : forall ps ws qs x, deep (Hull ps) ws qs x -> interior (Hull ps) x.
Proof.
  intros ps ws qs x [(L & W & I & T & ->) S]. destruct qs as [|q qs]; [contradiction|].
  destruct (least_weight ws W) as (m & M & G).
  destruct (spread_affine q qs m S M) as (e & E & N). exists e. split; [assumption|].
  intros h J. destruct (N h J) as (us & LU & U & TU & <-).
  assert (K : length us = length ws) by congruence.
  rewrite <- sums_mean by assumption. apply chosen_inside; try assumption.
  - rewrite sums_length; assumption.
  - eapply Forall_impl; [|exact (sums_least _ _ _ _ K G U)]. cbn. intros. lra.
  - rewrite sums_total by assumption. lra.
Qed.

Lemma deep_interior : forall c ws qs x, deep c ws qs x -> interior c x.
Proof.
  intros [p F|p M|p r|lo hi|ps|c p A l] ws qs x H; [..|apply (hull_deep _ _ _ _ H)|contradiction];
    cbn [deep] in H; unfold interior.
  - destruct H as [D H]. rewrite <- gram_form in H.
    destruct (form_near _ _ _ H) as (e & E & N). exists e. split; [assumption|]. intros h I.
    specialize (N h I). rewrite gram_form, <- sub_add in N. apply ellipsoid_inside; assumption.
  - destruct H as [P H]. destruct (form_near _ _ _ H) as (e & E & N). exists e. split; [assumption|]. intros h I.
    specialize (N h I). rewrite <- sub_add in N. apply shape_inside; assumption.
  - destruct H as [R0 H]. rewrite <- unit_form in H.
    destruct (form_near _ _ _ H) as (e & E & N). exists e. split; [assumption|]. intros h I.
    specialize (N h I). rewrite unit_form, <- sub_add in N. split; assumption.
  - destruct H as (X & Y & Z).
    destruct (both _ _ (between_near _ _ _ (Vec 1 0 0) X) (both _ _ (between_near _ _ _ (Vec 0 1 0) Y)
      (between_near _ _ _ (Vec 0 0 1) Z))) as (e & E & N).
    exists e. split; [assumption|]. intros h I. destruct (N h I) as (HX & HY & HZ).
    destruct x, h. cbn [inside]. plain. repeat split; lra.
Qed.

Lemma cut_interior : forall c p A l x, interior c x -> form A (sub x p) < l -> interior (Cut c p A l) x.
Proof.
  intros c p A l x I F. destruct (both _ _ I (form_near _ _ _ F)) as (e & E & N).
  exists e. split; [assumption|]. intros h J. destruct (N h J) as [X Y]. split; [exact X|]. rewrite sub_add. exact Y.
Qed.

Lemma interior_inside : forall c x, interior c x -> inside c x.
Proof.
  intros c x (e & E & H). replace x with (add x zero) by veq. apply H. unfold near.
  replace (dot zero zero) with 0 by veq. apply square_pos.
Qed.

(* One pair of pieces that meet, one of them strictly. *)
Lemma near_sum : forall e h d t, 0 < e -> 0 <= t -> near (e / (2 * (t + 1))) h -> near (e / (2 * (t + 1))) d ->
  near e (add h (scale t d)).
Proof.
  intros e h d t E T H D. set (f := e / (2 * (t + 1))) in *.
  assert (F : 0 < f) by (apply Rdiv_lt_0_compat; lra).
  assert (EF : e = 2 * (t + 1) * f) by (unfold f; field; lra).
  unfold near in *. pose proof (dot_self (sub h (scale t d))) as Q.
  replace (dot (sub h (scale t d)) (sub h (scale t d))) with (dot h h - 2 * (t * dot h d) + t * t * dot d d) in Q by veq.
  replace (dot (add h (scale t d)) (add h (scale t d))) with (dot h h + 2 * (t * dot h d) + t * t * dot d d) by veq.
  assert (t * t * dot d d <= t * t * (f * f)) by (apply Rmult_le_compat_l; [apply square_pos|assumption]).
  assert (0 <= f * f) by apply square_pos. rewrite EF.
  replace (2 * (t + 1) * f * (2 * (t + 1) * f)) with (4 * (t * t + 2 * t + 1) * (f * f)) by ring.
  assert (0 <= t * (f * f)) by (apply Rmult_le_pos; assumption).
  assert (0 <= t * t * (f * f)) by (apply Rmult_le_pos; [apply square_pos|assumption]). lra.
Qed.

Lemma in_sound : forall k a b t x, In a (agent k) -> In b (obstacle k) -> 0 <= t -> in_time (when k) t ->
  (interior a (sub x (scale t (vA k))) /\ inside_at b (vB k) t x
   \/ inside_at a (vA k) t x /\ interior b (sub x (scale t (vB k)))) ->
  in_cone k.
Proof.
  intros k a b t x IA IB T0 T H.
  destruct H as [[(e & E & N) HB]|[HA (e & E & N)]]; exists (e / (2 * (t + 1)));
    (split; [apply Rdiv_lt_0_compat; lra|]); intros h d Hh Hd; exists t.
  - exists x. split; [assumption|]. split; [exists a|exists b]; (split; [assumption|]); [|assumption].
    replace (sub (sub x h) (scale t (add (vA k) d)))
      with (add (sub x (scale t (vA k))) (opp (add h (scale t d)))) by (generalize (vA k); veq).
    apply N, near_opp, near_sum; assumption.
  - exists (add x (add h (scale t d))). split; [assumption|]. split; [exists a|exists b]; (split; [assumption|]).
    + replace (sub (sub (add x (add h (scale t d))) h) (scale t (add (vA k) d))) with (sub x (scale t (vA k)))
        by (generalize (vA k); veq). assumption.
    + rewrite sub_add. apply N, near_sum; assumption.
Qed.
