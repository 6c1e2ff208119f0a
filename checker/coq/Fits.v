(* One body inside another, by the corners of its pieces. *)
From Vericone Require Export Check.
Open Scope Q_scope.

(* Each point of the agent is in the obstacle. *)
Definition contained (A B : body R) : Prop := forall x, within_body A x -> within_body B x.

Open Scope R_scope.
Definition semi (M : mat R) : Prop := (forall u v, dot u (mul M v) = dot v (mul M u)) /\ forall u, 0 <= form M u.

(* What a positive form does not exceed at the corners it does not exceed between them. *)
Lemma form_between : forall M p k ps x, semi M -> inside (Hull ps) x ->
  (forall v, In v ps -> form M (sub v p) <= k) -> form M (sub x p) <= k.
Proof.
  intros M p k ps x [S P] I H. set (d := sub x p). set (n := mul M d).
  assert (L : dot n x <= dot n p + (form M d + k) / 2).
  { apply (hull_between n _ ps x I). intros v V. specialize (H v V). set (e := sub v p) in *.
    pose proof (P (sub d e)) as Q.
    assert (E : form M (sub d e) = form M d - dot d (mul M e) - dot e (mul M d) + form M e) by (generalize d e; clear; veq).
    rewrite (S d e) in E. assert (N : dot n v = dot n p + dot e (mul M d)) by (unfold n, e; generalize (mul M d); clear; veq). lra. }
  assert (E : dot n x = dot n p + form M d).
  { unfold form. rewrite (dot_sym d). fold n. unfold d. generalize n. clear. veq. }
  lra.
Qed.

Lemma unit_semi : semi unit_shape.
Proof. split; [unfold unit_shape; clear; veq|]. intros u. rewrite unit_form. apply dot_self. Qed.
Lemma gram_semi : forall A, semi (gram A).
Proof. intros A. split; [unfold gram; clear; veq|]. intros u. rewrite gram_form. apply dot_self. Qed.
Lemma adj_semi : forall M, positive_shape M -> semi (adj M).
Proof.
  intros M P. split.
  - destruct M as [[a b c] [b' d f] [c' f' g]]. destruct P as (E1 & E2 & E3 & _). cbn [vx vy vz r1 r2 r3] in *. subst.
    clear. veq.
  - intros u. pose proof (positive_form M (mul (adj M) u) P) as N.
    assert (Q : form M (mul (adj M) u) = det M * form (adj M) u).
    { unfold form at 1. rewrite mul_adj, dot_scale. unfold form. rewrite dot_sym. reflexivity. }
    rewrite Q in N. assert (0 < det M) by apply P.
    destruct (Rle_dec 0 (form (adj M) u)); [assumption|nra].
Qed.

(* A box is the hull of its corners. *)
Lemma part_of : forall lo hi x, lo <= x <= hi -> exists s, 0 <= s <= 1 /\ x = (1 - s) * lo + s * hi.
Proof.
  intros lo hi x H. destruct (Req_dec lo hi) as [E|E].
  - exists 0. split; lra.
  - exists ((x - lo) / (hi - lo)). assert (0 < / (hi - lo)) by (apply Rinv_0_lt_compat; lra).
    split; [split|field; lra].
    + unfold Rdiv. apply Rmult_le_pos; lra.
    + apply (Rmult_le_reg_r (hi - lo)); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.
Lemma box_hull : forall a b c a' b' c' x, inside (Box (Vec a b c) (Vec a' b' c')) x ->
  inside (Hull [Vec a b c; Vec a' b c; Vec a b' c; Vec a' b' c; Vec a b c'; Vec a' b c'; Vec a b' c'; Vec a' b' c']) x.
Proof.
  intros a b c a' b' c' [x y z] (X & Y & Z). cbn [vx vy vz] in *.
  destruct (part_of _ _ _ X) as (r & R & ->). destruct (part_of _ _ _ Y) as (s & S & ->).
  destruct (part_of _ _ _ Z) as (t & T & ->).
  exists [(1-r)*(1-s)*(1-t); r*(1-s)*(1-t); (1-r)*s*(1-t); r*s*(1-t); (1-r)*(1-s)*t; r*(1-s)*t; (1-r)*s*t; r*s*t].
  split; [reflexivity|]. split; [|split].
  - repeat (apply Forall_cons; [repeat apply Rmult_le_pos; lra|]). apply Forall_nil.
  - cbn. ring.
  - cbn. plain. f_equal; ring.
Qed.
Lemma corners_hull : forall c x, has_corners c = true -> inside (rc c) x -> inside (Hull (map rv (corners c))) x.
Proof.
  intros [p F|p M|p r|[a b c] [a' b' c']|ps|c p A l] x H I; try discriminate H; cbn [corners].
  - cbn in H. rewrite H. apply eq_real in H. rewrite Q2R_zero in H. cbn [rc inside] in I. rewrite H in I. destruct I as [_ I].
    assert (E : sub x (rv p) = zero) by (apply dot_self_zero; lra).
    exists [1]. split; [reflexivity|]. split; [constructor; [lra|constructor]|]. split; [cbn; lra|].
    transitivity (add (rv p) (sub x (rv p))); [generalize (rv p); clear; veq|]. rewrite E. cbn. generalize (rv p). clear. veq.
  - apply box_hull, I.
  - exact I.
Qed.

(* u^T A v <= level for any two corners proves it of what lies between them. *)
Lemma mean_twice : forall M p l ps x, (forall u v, dot u (mul M v) = dot v (mul M u)) -> inside (Hull ps) x ->
  (forall u v, In u ps -> In v ps -> dot (sub u p) (mul M (sub v p)) <= l) -> form M (sub x p) <= l.
Proof.
  intros M p l ps x S I H.
  assert (Affine : forall n y q k, dot (sub y q) n <= k <-> dot n y <= dot n q + k).
  { intros n y q k. replace (dot (sub y q) n) with (dot n y - dot n q) by (clear; veq). lra. }
  assert (One : forall u, In u ps -> dot (sub x p) (mul M (sub u p)) <= l).
  { intros u U. apply Affine. apply (hull_between _ _ ps x I). intros v V. apply Affine. apply H; assumption. }
  unfold form. apply Affine. apply (hull_between _ _ ps x I). intros v V. apply Affine. rewrite S. apply One, V.
Qed.

Open Scope Q_scope.
Fixpoint vertices_in (c : convex Q) (ps : list (vec Q)) : bool :=
  match c with
  | Cut c p A l =>
      vertices_in c ps && eq (vy (r1 A)) (vx (r2 A)) && eq (vz (r1 A)) (vx (r3 A)) && eq (vz (r2 A)) (vy (r3 A)) &&
      forallb (fun u => forallb (fun v => le (dotq (subq u p) (mulq A (subq v p))) l) ps) ps
  | Hull _ => false
  | c => forallb (memberq false c []) ps
  end.
Lemma vertices_in_real : forall c ps x, vertices_in c ps = true -> inside (Hull (map rv ps)) x -> inside (rc c) x.
Proof.
  assert (Each : forall (P : vec R -> Prop) (f : vec Q -> bool) ps, (forall v, f v = true -> P (rv v)) ->
    forallb f ps = true -> forall v, In v (map rv ps) -> P v).
  { intros P f ps Pf F v V. apply in_map_iff in V. destruct V as (w & <- & W). rewrite forallb_forall in F. apply Pf, F, W. }
  induction c as [p F|p M|p r|lo hi|qs|c IH p A l]; intros ps x H I; cbn [vertices_in] in H; try discriminate H; cbn [rc].
  - assert (W : forall v, In v (map rv ps) -> det (rm F) <> 0%R /\ (form (gram (adj (rm F))) (sub v (rv p)) <= det (rm F) * det (rm F))%R).
    { apply (Each _ (memberq false (Ellipsoid p F) [])); [|exact H]. intros v K. cbn [memberq] in K. cbv zeta in K.
      apply andb_prop in K. destruct K as [D K]. apply neq_real in D. rewrite Q2R_det, Q2R_zero in D.
      apply lessq_real in K. destruct K as [K _]. rewrite Q2R_dot, rv_mul, rm_adj, rv_sub, Q2R_mult, Q2R_det in K.
      rewrite gram_form. split; assumption. }
    assert (D : det (rm F) <> 0%R).
    { destruct ps as [|q ps]; [destruct I as ([|w ws] & L & _ & T & _); [cbn in T; lra|discriminate L]|].
      apply (W (rv q)). left; reflexivity. }
    apply ellipsoid_inside; [exact D|]. rewrite <- gram_form.
    apply (form_between _ _ _ _ _ (gram_semi _) I). intros v J. apply W, J.
  - assert (W : forall v, In v (map rv ps) -> positive_shape (rm M) /\ (form (adj (rm M)) (sub v (rv p)) <= det (rm M))%R).
    { apply (Each _ (memberq false (Shaped p M) [])); [|exact H]. intros v K. cbn [memberq] in K.
      apply andb_prop in K. destruct K as [D K]. apply positive_shapeq_real in D.
      apply lessq_real in K. destruct K as [K _]. rewrite Q2R_form, rm_adj, rv_sub, Q2R_det in K. split; assumption. }
    assert (D : positive_shape (rm M)).
    { destruct ps as [|q ps]; [destruct I as ([|w ws] & L & _ & T & _); [cbn in T; lra|discriminate L]|].
      apply (W (rv q)). left; reflexivity. }
    apply shape_inside; [exact D|]. apply (form_between _ _ _ _ _ (adj_semi _ D) I). intros v J. apply W, J.
  - assert (W : forall v, In v (map rv ps) -> (0 <= Q2R r)%R /\ (form unit_shape (sub v (rv p)) <= Q2R r * Q2R r)%R).
    { apply (Each _ (memberq false (Ball p r) [])); [|exact H]. intros v K. cbn [memberq] in K.
      apply andb_prop in K. destruct K as [D K]. apply le_real in D. rewrite Q2R_zero in D.
      apply lessq_real in K. destruct K as [K _]. rewrite Q2R_dot, rv_sub, Q2R_mult in K. rewrite unit_form. split; assumption. }
    assert (D : (0 <= Q2R r)%R).
    { destruct ps as [|q ps]; [destruct I as ([|w ws] & L & _ & T & _); [cbn in T; lra|discriminate L]|].
      apply (W (rv q)). left; reflexivity. }
    split; [exact D|]. rewrite <- unit_form. apply (form_between _ _ _ _ _ unit_semi I). intros v J. apply W, J.
  - assert (W : forall v, In v (map rv ps) -> inside (rc (Box lo hi)) v).
    { apply (Each _ (memberq false (Box lo hi) [])); [|exact H]. intros v K. apply (memberq_inside _ _ _ _ K). }
    cbn [rc inside] in W. destruct x as [x y z].
    assert (B : forall n l, (forall v, In v (map rv ps) -> (dot n v <= l)%R) -> (dot n (Vec x y z) <= l)%R)
      by (intros n l K; apply (hull_between _ _ _ _ I K)).
    pose proof (B (Vec 1 0 0)%R (vx (rv hi))) as X1. pose proof (B (Vec (-1) 0 0)%R (- vx (rv lo))%R) as X2.
    pose proof (B (Vec 0 1 0)%R (vy (rv hi))) as Y1. pose proof (B (Vec 0 (-1) 0)%R (- vy (rv lo))%R) as Y2.
    pose proof (B (Vec 0 0 1)%R (vz (rv hi))) as Z1. pose proof (B (Vec 0 0 (-1))%R (- vz (rv lo))%R) as Z2.
    clear B. unfold dot in *. cbn [vx vy vz] in *.
    assert (X1' := X1 ltac:(intros v J; specialize (W v J); lra)). assert (X2' := X2 ltac:(intros v J; specialize (W v J); lra)).
    assert (Y1' := Y1 ltac:(intros v J; specialize (W v J); lra)). assert (Y2' := Y2 ltac:(intros v J; specialize (W v J); lra)).
    assert (Z1' := Z1 ltac:(intros v J; specialize (W v J); lra)). assert (Z2' := Z2 ltac:(intros v J; specialize (W v J); lra)).
    cbn [inside vx vy vz]. lra.
  - repeat match goal with K : (_ && _)%bool = true |- _ => apply andb_prop in K; destruct K end.
    repeat match goal with K : eq _ _ = true |- _ => apply eq_real in K end. cbn [inside]. split; [apply (IH ps); assumption|].
    apply (mean_twice _ _ _ (map rv ps)); [|exact I|].
    + intros u v. destruct A as [[a b c'] [b' d f] [c'' f' g]]. cbn [r1 r2 r3 vx vy vz] in *. unfold rm, rv. cbn [r1 r2 r3 vx vy vz].
      match goal with E1 : Q2R b = _, E2 : Q2R c' = _, E3 : Q2R f = _ |- _ => rewrite E1, E2, E3 end. clear. veq.
    + intros u v U V. apply in_map_iff in U, V. destruct U as (u' & <- & U). destruct V as (v' & <- & V).
      match goal with K : forallb _ ps = true |- _ => rewrite forallb_forall in K; specialize (K _ U); cbv beta in K;
        rewrite forallb_forall in K; specialize (K _ V); apply le_real in K end.
      rewrite Q2R_dot, rv_mul, !rv_sub in *. assumption.
Qed.

Inductive fit_proof :=
  | Vertices (obstacle_piece : Z)
  | Parts (of_agent : bool) (runs : list (Z * Z)) (proofs : list fit_proof).

Fixpoint check_inside (fuel : nat) (A B : group) (p : fit_proof) : bool :=
  match fuel with
  | O => false
  | S fuel =>
      match p with
      | Vertices k =>
          match find B k with
          | Some c => forallb (fun a => has_corners (snd a) && vertices_in c (corners (snd a))) A
          | None => false
          end
      | Parts true runs proofs => in_groups (fun g p => check_inside fuel g B p) runs proofs A
      | Parts false runs proofs => in_groups (fun g p => check_inside fuel A g p) runs proofs B
      end
  end.
Lemma check_inside_real : forall fuel A B p, check_inside fuel A B p = true -> forall a, In a A ->
  B <> [] -> forall x, inside (rc (snd a)) x -> exists b, In b B /\ inside (rc (snd b)) x.
Proof.
  induction fuel as [|fuel IH]; intros A B p H a I N x X; [discriminate H|]. destruct p as [k|[] runs proofs]; cbn [check_inside] in H.
  - destruct (find B k) as [c|] eqn:E; [|discriminate H]. rewrite forallb_forall in H. specialize (H _ I).
    apply andb_prop in H. destruct H as [C V]. apply find_in in E. apply in_map_iff in E. destruct E as (b & <- & J).
    exists b. split; [exact J|]. apply (vertices_in_real _ _ _ V), corners_hull; assumption.
  - destruct (in_groups_all _ _ _ _ _ a H I) as (s & q & S & _ & F). apply (IH _ _ _ F a S N x X).
  - destruct B as [|b0 B]; [contradiction|].
    destruct (in_groups_all _ _ _ _ _ b0 H (or_introl eq_refl)) as (s & q & _ & Q & _).
    destruct (in_groups_each _ _ _ _ _ q H Q) as (g & G & Ne & Sub).
    destruct (IH _ _ _ G a I Ne x X) as (b & J & K). exists b. split; [apply Sub, J|exact K].
Qed.

Definition check_contained (A B : body Q) (p : fit_proof) : bool :=
  filled A && filled B && check_inside depth (numbered 0 A) (numbered 0 B) p.
Theorem check_contained_sound : forall A B p, check_contained A B p = true -> contained (map rc A) (map rc B).
Proof.
  intros A B p H x (a & I & X). unfold check_contained in H. apply andb_prop in H. destruct H as [H C].
  apply andb_prop in H. destruct H as [_ FB]. apply of_numbered in I. destruct I as (na & I & ->).
  assert (N : numbered 0 B <> []) by (destruct B; [discriminate FB|discriminate]).
  destruct (check_inside_real _ _ _ _ C na I N x X) as ([j b] & J & K). exists (rc b). split; [|exact K].
  apply in_map, (numbered_in _ _ _ _ _ J).
Qed.
