(* Boxes that hold pieces. *)
From Vericone Require Export Dents.
Open Scope Q_scope.

Definition ordered (lo hi : vec Q) := le (vx lo) (vx hi) && le (vy lo) (vy hi) && le (vz lo) (vz hi).
Definition in_box (c : convex Q) (lo hi : vec Q) : bool :=
  match c with
  | Ball p r =>
      le 0 r && le (vx lo + r) (vx p) && le (vy lo + r) (vy p) && le (vz lo + r) (vz p) &&
      le (vx p + r) (vx hi) && le (vy p + r) (vy hi) && le (vz p + r) (vz hi)
  | Hull ps => forallb (fun v => ordered lo v && ordered v hi) ps
  | Box a b => ordered lo a && ordered b hi
  | _ => false
  end.

Lemma hull_between : forall n l ps x, inside (Hull ps) x -> (forall p, In p ps -> (dot n p <= l)%R) -> (dot n x <= l)%R.
Proof.
  intros n l ps x (ws & L & W & T & ->) H. pose proof (mean_le n l ps ws L W H) as M. rewrite T in M. lra.
Qed.
Lemma ordered_real : forall a b, ordered a b = true ->
  (vx (rv a) <= vx (rv b))%R /\ (vy (rv a) <= vy (rv b))%R /\ (vz (rv a) <= vz (rv b))%R.
Proof.
  intros a b H. unfold ordered in H. apply andb_prop in H. destruct H as [H Z]. apply andb_prop in H. destruct H as [X Y].
  apply le_real in X, Y, Z. auto.
Qed.
Lemma within_radius : forall a b c r, (0 <= r)%R -> (a * a + b * b + c * c <= r * r)%R -> (- r <= a <= r)%R.
Proof.
  intros a b c r R H. pose proof (Rle_0_sqr b) as B. pose proof (Rle_0_sqr c) as C. unfold Rsqr in B, C.
  split; [apply Ropp_le_cancel; rewrite Ropp_involutive|]; apply square_le; try assumption; lra.
Qed.
Lemma in_box_real : forall c lo hi, in_box c lo hi = true -> forall x, inside (rc c) x -> inside (rc (Box lo hi)) x.
Proof.
  intros c lo hi H x I. destruct c as [| |p r|a b|ps|]; try discriminate H; cbn [in_box] in H; cbn [rc inside].
  - repeat match goal with K : (_ && _)%bool = true |- _ => apply andb_prop in K; destruct K end.
    repeat match goal with K : le _ _ = true |- _ => apply le_real in K; try rewrite Q2R_plus in K end.
    rewrite Q2R_zero in *. cbn [rc inside] in I. destruct I as [_ I].
    destruct x as [x y z], p as [px py pz], lo as [a b c], hi as [a' b' c'].
    unfold dot, sub, add, opp, rv in *. cbn [vx vy vz] in *.
    set (dx := (x - Q2R px)%R) in *. set (dy := (y - Q2R py)%R) in *. set (dz := (z - Q2R pz)%R) in *.
    pose proof (within_radius dx dy dz (Q2R r)). pose proof (within_radius dy dx dz (Q2R r)).
    pose proof (within_radius dz dx dy (Q2R r)). unfold dx, dy, dz in *.
    repeat split; lra.
  - apply andb_prop in H. destruct H as [A B]. apply ordered_real in A, B. cbn [rc inside] in I. lra.
  - rewrite forallb_forall in H.
    assert (C : forall n l, (forall v, In v ps -> (dot n (rv v) <= l)%R) -> (dot n x <= l)%R).
    { intros n l K. apply (hull_between n l (map rv ps) x I). intros v J. apply in_map_iff in J. destruct J as (w & <- & J).
      apply K, J. }
    assert (O : forall v, In v ps -> (vx (rv lo) <= vx (rv v) <= vx (rv hi))%R /\
      (vy (rv lo) <= vy (rv v) <= vy (rv hi))%R /\ (vz (rv lo) <= vz (rv v) <= vz (rv hi))%R).
    { intros v J. specialize (H v J). apply andb_prop in H. destruct H as [A B]. apply ordered_real in A, B. lra. }
    pose proof (C (Vec 1 0 0)%R (vx (rv hi))) as X1. pose proof (C (Vec (-1) 0 0)%R (- vx (rv lo))%R) as X0.
    pose proof (C (Vec 0 1 0)%R (vy (rv hi))) as Y1. pose proof (C (Vec 0 (-1) 0)%R (- vy (rv lo))%R) as Y0.
    pose proof (C (Vec 0 0 1)%R (vz (rv hi))) as Z1. pose proof (C (Vec 0 0 (-1))%R (- vz (rv lo))%R) as Z0.
    unfold dot in *. cbn [vx vy vz] in X1, X0, Y1, Y0, Z1, Z0.
    assert (P : forall v, In v ps -> _) by exact O.
    repeat match goal with K : (forall v, In v ps -> _) -> _ |- _ => specialize (K ltac:(intros v J; specialize (P v J); lra)) end.
    repeat split; lra.
Qed.
