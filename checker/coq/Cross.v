(* Bodies with corners, flat ones included: pairs of corners whose differences show that they meet. *)
From Vericone Require Export Points.
Open Scope R_scope.

Definition difference (p : vec R * vec R) := sub (snd p) (fst p).

Lemma mean_difference : forall prs ws, length ws = length prs ->
  mean ws (map difference prs) = sub (mean ws (map snd prs)) (mean ws (map fst prs)).
Proof.
  induction prs as [|[p q] prs IH]; intros [|w ws] L; try discriminate L; [cbn; veq|].
  cbn. rewrite IH by (injection L; auto). unfold difference. cbn. veq.
Qed.

Lemma mean_scaled : forall ds ws k, mean (map (Rmult k) ws) ds = scale k (mean ws ds).
Proof.
  induction ds as [|d ds IH]; intros [|w ws] k; try (cbn; veq). cbn. rewrite IH. veq.
Qed.
Lemma total_scaled : forall ws k, total (map (Rmult k) ws) = k * total ws.
Proof.
  induction ws as [|w ws IH]; intros k; [cbn; lra|]. specialize (IH k). unfold total in *. cbn. rewrite IH. ring.
Qed.

(* The corners of the pairs belong to pieces a and b. *)
Definition belong (a b : convex R) (prs : list (vec R * vec R)) : Prop :=
  exists ps qs, (forall x, inside (Hull ps) x -> inside a x) /\ (forall x, inside (Hull qs) x -> inside b x) /\
  Forall (fun p => In (fst p) ps /\ In (snd p) qs) prs.

Lemma pairs_meet : forall a b prs ws, belong a b prs -> length ws = length prs -> Forall (fun w => 0 <= w) ws ->
  total ws = 1 -> exists x, inside a x /\ inside b (add x (mean ws (map difference prs))).
Proof.
  intros a b prs ws (ps & qs & A & B & F) L W T. exists (mean ws (map fst prs)). split.
  - apply A, chosen_inside; try assumption; [rewrite map_length; assumption|].
    apply Forall_map. eapply Forall_impl; [|exact F]. cbn. intros p [P _]. exact P.
  - rewrite mean_difference by assumption.
    replace (add (mean ws (map fst prs)) (sub (mean ws (map snd prs)) (mean ws (map fst prs))))
      with (mean ws (map snd prs)) by (generalize (mean ws (map snd prs)) (mean ws (map fst prs)); veq).
    apply B, chosen_inside; try assumption; [rewrite map_length; assumption|].
    apply Forall_map. eapply Forall_impl; [|exact F]. cbn. intros p [_ P]. exact P.
Qed.

(* A common point at the time t, of A moved by h and as fast as v. *)
Lemma pairs_there : forall k a b prs ws t v h, In a (agent k) -> In b (obstacle k) -> belong a b prs ->
  length ws = length prs -> Forall (fun w => 0 <= w) ws -> total ws = 1 ->
  mean ws (map difference prs) = add h (scale t (sub v (vB k))) ->
  exists x, there (agent k) v t (sub x h) /\ there (obstacle k) (vB k) t x.
Proof.
  intros k a b prs ws t v h IA IB F L W T E. destruct (pairs_meet a b prs ws F L W T) as (x & X & Y).
  rewrite E in Y. exists (add (add x h) (scale t v)). split; [exists a|exists b]; (split; [assumption|]).
  - replace (sub (sub (add (add x h) (scale t v)) h) (scale t v)) with x by veq. assumption.
  - replace (sub (add (add x h) (scale t v)) (scale t (vB k))) with (add x (add h (scale t (sub v (vB k)))))
      by (generalize (vB k); veq). assumption.
Qed.

Lemma normal_weights : forall ws, Forall (fun w => 0 < w) ws -> ws <> [] -> 0 < total ws.
Proof.
  intros [|w ws] F N; [contradiction|]. clear N. inversion F; subst. cbn.
  assert (0 <= fold_right Rplus 0 ws); [|lra].
  clear - H2. induction ws as [|u ws IH]; [cbn; lra|]. inversion H2; subst. cbn. specialize (IH H3). lra.
Qed.

(* They overlap at the time t. *)
Lemma cross_overlap : forall k a b p prs ws t, In a (agent k) -> In b (obstacle k) -> belong a b (p :: prs) ->
  length ws = length (p :: prs) -> Forall (fun w => 0 < w) ws -> total ws = 1 -> 0 <= t -> in_time (when k) t ->
  mean ws (map difference (p :: prs)) = scale t (sub (vA k) (vB k)) ->
  spread (map (fun d => sub d (difference p)) (map difference prs)) -> in_cone k.
Proof.
  intros k a b p prs ws t IA IB F L W T T0 Tt E S.
  destruct (least_weight ws W) as (m & M & G).
  destruct (spread_affine (difference p) (map difference prs) m S M) as (e & E0 & N).
  exists (e / (2 * (t + 1))). split; [apply Rdiv_lt_0_compat; lra|]. intros h d Hh Hd.
  destruct (N _ (near_sum e h d t E0 T0 Hh Hd)) as (us & LU & U & TU & EU).
  cbn [length] in LU. rewrite map_length in LU.
  assert (LK : length us = length ws) by (rewrite LU, L; reflexivity).
  destruct (pairs_there k a b (p :: prs) (sums ws us) t (add (vA k) d) h IA IB F) as (x & X & Y).
  - rewrite sums_length; assumption.
  - eapply Forall_impl; [|exact (sums_least _ _ _ _ LK G U)]. cbn. intros. lra.
  - rewrite sums_total by assumption. lra.
  - rewrite sums_mean; [|assumption|rewrite map_length; assumption]. rewrite E. cbn [map]. rewrite EU.
    generalize (vA k) (vB k). veq.
  - exists t, x. repeat split; try assumption; apply Tt.
Qed.

(* They cross between the first and the last time. *)
Lemma small_enough : forall l t t0 T, 0 < l -> 0 <= t0 < t -> match T with None => True | Some T => t < T end ->
  exists m, 0 < m /\ m <= 1 / 2 /\ m * t <= 1 / 2 /\ m * (1 + 2 * (/ t + 1)) <= l /\ m * (1 + t0) * t <= t - t0 /\
  match T with None => True | Some T => m * (1 + T) * t <= T - t end.
Proof.
  intros l t t0 T L [T0 Tt] HT.
  assert (It : 0 < / t) by (apply Rinv_0_lt_compat; lra).
  assert (Pick : forall k r, 0 < k -> 0 < r -> exists m, 0 < m /\ forall n, 0 < n -> n <= m -> n * k <= r).
  { intros k r K R0. exists (r / k). assert (P : 0 < r / k) by (apply Rdiv_lt_0_compat; assumption).
    split; [assumption|]. intros n N H. replace r with (r / k * k) by (field; lra). apply Rmult_le_compat_r; lra. }
  destruct (Pick 1 (1 / 2)) as (a & A & HA); [lra|lra|].
  destruct (Pick t (1 / 2)) as (b & B & HB); [lra|lra|].
  destruct (Pick (1 + 2 * (/ t + 1)) l) as (c & C & HC); [lra|lra|].
  destruct (Pick ((1 + t0) * t) (t - t0)) as (d & D & HD); [nra|lra|].
  assert (X : exists e, 0 < e /\ forall n, 0 < n -> n <= e ->
    match T with None => True | Some T => n * (1 + T) * t <= T - t end).
  { destruct T as [T|]; [|exists 1; split; [lra|trivial]].
    destruct (Pick ((1 + T) * t) (T - t)) as (e & E & HE); [apply Rmult_lt_0_compat; lra|lra|].
    exists e. split; [assumption|]. intros n N H. specialize (HE n N H). lra. }
  destruct X as (e & E & HE).
  set (m := Rmin (Rmin (Rmin a b) (Rmin c d)) e).
  assert (M : 0 < m) by (repeat apply Rmin_glb_lt; assumption).
  pose proof (Rmin_l (Rmin (Rmin a b) (Rmin c d)) e) as M1. pose proof (Rmin_r (Rmin (Rmin a b) (Rmin c d)) e).
  pose proof (Rmin_l (Rmin a b) (Rmin c d)). pose proof (Rmin_r (Rmin a b) (Rmin c d)).
  pose proof (Rmin_l a b). pose proof (Rmin_r a b). pose proof (Rmin_l c d). pose proof (Rmin_r c d).
  fold m in M1, H. exists m. split; [assumption|].
  specialize (HA m M ltac:(lra)). specialize (HB m M ltac:(lra)). specialize (HC m M ltac:(lra)).
  specialize (HD m M ltac:(lra)). specialize (HE m M ltac:(lra)).
  repeat split; try lra. exact HE.
Qed.

Lemma cross_passing : forall k a b prs ws t, In a (agent k) -> In b (obstacle k) -> belong a b prs ->
  length ws = length prs -> Forall (fun w => 0 < w) ws -> total ws = 1 ->
  0 <= from (when k) < t -> match until (when k) with None => True | Some T => t < T end ->
  mean ws (map difference prs) = scale t (sub (vA k) (vB k)) ->
  spread (map difference prs) -> in_cone k.
Proof.
  intros k a b prs ws t IA IB F L W T Ht0 Ht1 E S.
  destruct (least_weight ws W) as (l & L0 & G).
  assert (t0 : 0 < t) by lra. assert (It : 0 < / t) by (apply Rinv_0_lt_compat; assumption).
  assert (Ltp : 0 < / t * l) by (apply Rmult_lt_0_compat; assumption).
  destruct (small_enough (/ t * l) t (from (when k)) (until (when k)) Ltp Ht0 Ht1)
    as (m & M & M1 & M2 & M3 & M4 & M5).
  destruct (spread_combines (map difference prs) m S M) as (e & E0 & N).
  exists e. split; [assumption|]. intros h d Hh Hd.
  destruct (N d Hd) as (us & LU & U & [TU TU'] & EU). destruct (N h Hh) as (vs & LV & V & [TV TV'] & EV).
  rewrite map_length in LU, LV.
  set (al := sums (map (Rmult (/ t)) ws) us).
  assert (La : length us = length (map (Rmult (/ t)) ws)) by (rewrite map_length; congruence).
  assert (Ta : total al = / t + total us).
  { unfold al. rewrite sums_total, total_scaled, T by assumption. ring. }
  assert (tt : t * / t = 1) by (apply Rinv_r; lra).
  assert (mt : m <= / t * (1 / 2)).
  { apply (Rmult_le_reg_l t); [assumption|]. rewrite <- Rmult_assoc, tt. lra. }
  assert (Pa : 0 < total al) by (rewrite Ta; lra).
  set (ka := total al / (1 - total vs)).
  assert (Pk : 0 < ka) by (apply Rdiv_lt_0_compat; lra).
  assert (Ek : ka * (1 - total vs) = total al) by (unfold ka; field; lra).
  assert (K2 : ka <= 2 * (/ t + 1)) by nra.
  set (be := map (Rmult ka) vs).
  assert (Lal : length al = length prs) by (unfold al; rewrite sums_length, map_length; congruence).
  assert (Lbe : length be = length al) by (unfold be; rewrite map_length; congruence).
  set (si := sums al be).
  assert (Tsi : total si = ka).
  { unfold si, be. rewrite sums_total, total_scaled by assumption. lra. }
  assert (Esi : mean si (map difference prs) = add (sub (add (vA k) d) (vB k)) (scale ka h)).
  { unfold si, be. rewrite sums_mean, mean_scaled, EV; [|assumption|rewrite map_length; assumption].
    unfold al. rewrite sums_mean, mean_scaled, EU, E; [|assumption|rewrite !map_length; assumption].
    transitivity (add (add (scale (/ t * t) (sub (vA k) (vB k))) d) (scale ka h)).
    - generalize (/ t) (vA k) (vB k) ka. veq.
    - rewrite Rmult_comm, tt. generalize (vA k) (vB k) ka. veq. }
  assert (Psi : Forall (fun w => 0 <= w) si).
  { assert (Gal : Forall (fun w => / t * l - m <= w) al).
    { apply (sums_least _ m _ us La); [|assumption]. apply Forall_map. eapply Forall_impl; [|exact G].
      cbn. intros w Hw. apply Rmult_le_compat_l; lra. }
    assert (Gbe : Forall (little (ka * m)) be).
    { apply Forall_map. eapply Forall_impl; [|exact V]. unfold little. intros v Hv. split; nra. }
    eapply Forall_impl; [|exact (sums_least _ _ _ _ Lbe Gal Gbe)]. cbn. intros w Hw.
    assert (ka * m <= 2 * (/ t + 1) * m) by (apply Rmult_le_compat_r; lra). lra. }
  set (q := / ka). assert (Q : 0 < q) by (apply Rinv_0_lt_compat; assumption).
  assert (qk : q * ka = 1) by (apply Rinv_l; lra).
  destruct (pairs_there k a b prs (map (Rmult q) si) q (add (vA k) d) h IA IB F) as (x & X & Y).
  - unfold si. rewrite map_length, sums_length by assumption. assumption.
  - apply Forall_map. eapply Forall_impl; [|exact Psi]. cbn. intros w Hw. apply Rmult_le_pos; lra.
  - rewrite total_scaled, Tsi. assumption.
  - rewrite mean_scaled, Esi.
    transitivity (add (scale q (sub (add (vA k) d) (vB k))) (scale (q * ka) h)).
    + generalize q (vA k) (vB k) ka. veq.
    + rewrite qk. generalize (vA k) (vB k) q. veq.
  - exists q, x. split; [|split; assumption]. split.
    + assert (from (when k) * ka <= 1); [|nra].
      assert (from (when k) * (/ t + m) <= 1 - m).
      { apply (Rmult_le_reg_l t); [assumption|].
        replace (t * (from (when k) * (/ t + m))) with (from (when k) * (t * / t) + from (when k) * m * t) by ring.
        rewrite tt. lra. }
      assert (from (when k) * total al <= 1 - total vs).
      { eapply Rle_trans; [|apply Rle_trans with (1 - m); [exact H|lra]]. apply Rmult_le_compat_l; rewrite ?Ta; lra. }
      apply (Rmult_le_reg_r (1 - total vs)); [lra|]. rewrite Rmult_assoc, Ek. lra.
    + destruct (until (when k)) as [T1|]; [|trivial].
      assert (1 <= T1 * ka); [|nra].
      assert (1 + m <= T1 * (/ t - m)).
      { apply (Rmult_le_reg_l t); [assumption|].
        replace (t * (T1 * (/ t - m))) with (T1 * (t * / t) - T1 * m * t) by ring.
        rewrite tt. lra. }
      assert (1 - total vs <= T1 * total al).
      { apply Rle_trans with (1 + m); [lra|]. eapply Rle_trans; [exact H|]. apply Rmult_le_compat_l; rewrite ?Ta; lra. }
      apply (Rmult_le_reg_r (1 - total vs)); [lra|]. rewrite Rmult_assoc, Ek. lra.
Qed.
