(* Planes: how far a body reaches along n, and what follows when two bodies do not reach each other. *)
From Vericone Require Export Bodies.
Open Scope R_scope.

(* The greatest of n.v over the corners; 0 of none (no point is in a hull without corners). *)
Fixpoint highest (n : vec R) (ps : list (vec R)) : R :=
  match ps with
  | [] => 0
  | [p] => dot n p
  | p :: ps => Rmax (dot n p) (highest n ps)
  end.

(* n.x <= middle + sqrt bulge for every x of the body. *)
Fixpoint middle (c : convex R) (n : vec R) : R :=
  match c with
  | Ellipsoid p _ | Shaped p _ | Ball p _ => dot n p
  | Box lo hi => Rmax (vx n * vx lo) (vx n * vx hi) + Rmax (vy n * vy lo) (vy n * vy hi)
                 + Rmax (vz n * vz lo) (vz n * vz hi)
  | Hull ps => highest n ps
  | Cut c _ _ _ => middle c n
  end.
Fixpoint bulge (c : convex R) (n : vec R) : R :=
  match c with
  | Ellipsoid _ F => dot (mul (turn F) n) (mul (turn F) n)
  | Shaped _ M => form M n
  | Ball _ r => r * r * dot n n
  | Cut c _ _ _ => bulge c n
  | _ => 0
  end.

Lemma highest_le : forall ps n p, In p ps -> dot n p <= highest n ps.
Proof.
  induction ps as [|a ps IH]; intros n p H; [destruct H|].
  destruct ps as [|b ps].
  - destruct H as [->|[]]. cbn; lra.
  - change (highest n (a :: b :: ps)) with (Rmax (dot n a) (highest n (b :: ps))).
    destruct H as [->|H].
    + apply Rmax_l.
    + eapply Rle_trans; [apply IH, H | apply Rmax_r].
Qed.

Lemma mean_le : forall n l ps ws, length ws = length ps -> Forall (fun w => 0 <= w) ws ->
  (forall p, In p ps -> dot n p <= l) -> dot n (mean ws ps) <= l * total ws.
Proof.
  intros n l; induction ps as [|p ps IH]; intros [|w ws] L F H; try discriminate L.
  - cbn. unfold zero. plain. lra.
  - inversion F; subst. cbn [mean total fold_right]. rewrite dot_add, dot_scale.
    assert (dot n (mean ws ps) <= l * total ws).
    { apply IH; [injection L; auto | assumption |]. intros; apply H; right; assumption. }
    assert (dot n p <= l) by (apply H; left; reflexivity).
    unfold total in *. nra.
Qed.

Lemma product_max : forall a lo hi x, lo <= x <= hi -> a * x <= Rmax (a * lo) (a * hi).
Proof.
  intros a lo hi x H. destruct (Rle_dec 0 a).
  - eapply Rle_trans; [|apply Rmax_r]. nra.
  - eapply Rle_trans; [|apply Rmax_l]. nra.
Qed.

(* By its square: true of every reach above the square root of the bulge. *)
Lemma reach : forall c x n, inside c x ->
  0 <= bulge c n /\ forall r, 0 <= r -> bulge c n <= r * r -> dot n x <= middle c n + r.
Proof.
  induction c as [p F|p M|p s|lo hi|ps|c IH p A l]; intros x n H; cbn [middle bulge] in *; [..|apply IH, H].
  - destruct H as [u [U ->]]. split; [apply dot_self|]. intros r R0 Q.
    rewrite dot_add, dot_mul. set (m := mul (turn F) n) in *.
    pose proof (cauchy m u). pose proof (dot_self m).
    assert (dot m m * dot u u <= dot m m * 1) by (apply Rmult_le_compat_l; assumption).
    assert (dot m u <= r). { apply square_le; lra. } lra.
  - specialize (H n). rewrite dot_sub in H.
    split; [eapply Rle_trans; [apply Rle_0_sqr|exact H]|]. intros r R0 Q.
    assert (dot n x - dot n p <= r) by (apply square_le; lra). lra.
  - destruct H as [S H]. pose proof (dot_self n). split; [apply Rmult_le_pos; nra|]. intros r R0 Q.
    pose proof (cauchy n (sub x p)) as C. rewrite dot_sub in C.
    assert (dot n n * dot (sub x p) (sub x p) <= dot n n * (s * s)) by (apply Rmult_le_compat_l; assumption).
    assert (dot n x - dot n p <= r) by (apply square_le; lra). lra.
  - split; [lra|]. intros r R0 _. destruct H as (X & Y & Z). unfold dot.
    pose proof (product_max (vx n) _ _ _ X). pose proof (product_max (vy n) _ _ _ Y).
    pose proof (product_max (vz n) _ _ _ Z). lra.
  - split; [lra|]. intros r R0 _. destruct H as (ws & L & W & T & ->).
    pose proof (mean_le n (highest n ps) ps ws L W (fun p H => highest_le ps n p H)) as M.
    rewrite T in M. lra.
Qed.

Lemma reach_sqrt : forall c x n, inside c x -> 0 <= bulge c n /\ dot n x <= middle c n + sqrt (bulge c n).
Proof.
  intros c x n H. destruct (reach c x n H) as [Q L]. split; [assumption|].
  apply L; [apply sqrt_pos | rewrite sqrt_sqrt; [lra|assumption]].
Qed.

(* Two square roots and their sum, compared without roots. *)
Definition beyond (gap qA qB : R) : Prop :=
  0 < gap /\ 0 < gap * gap - qA - qB /\ 4 * qA * qB < (gap * gap - qA - qB) * (gap * gap - qA - qB).

Lemma beyond_roots : forall gap qA qB, 0 <= qA -> 0 <= qB -> beyond gap qA qB -> sqrt qA + sqrt qB < gap.
Proof.
  intros gap qA qB A B (G & D & E). pose proof (sqrt_pos qA). pose proof (sqrt_pos qB).
  pose proof (sqrt_sqrt qA A). pose proof (sqrt_sqrt qB B).
  set (a := sqrt qA) in *. set (b := sqrt qB) in *.
  assert (0 <= a * b) by nra.
  assert (2 * (a * b) < gap * gap - qA - qB).
  { apply square_lt; [lra|]. rewrite <- H1, <- H2 in *. nra. }
  apply square_lt; nra.
Qed.

(* The greatest of t n.w over the times; of all times there is one if n.w <= 0. *)
Definition slides (n w : vec R) (h : horizon R) (s : R) : Prop :=
  from h * dot n w <= s /\ match until h with None => dot n w <= 0 | Some T => T * dot n w <= s end.

Lemma slide : forall n w h s t, slides n w h s -> in_time h t -> t * dot n w <= s.
Proof.
  intros n w [t0 [T|]] s t [S0 H] [F Tt]; cbn in *; destruct (Rle_dec (dot n w) 0); nra.
Qed.

(* "c has n.x <= l". *)
Definition reach_below (n : vec R) (l : R) (c : convex R) : Prop :=
  0 <= l - middle c n /\ bulge c n <= (l - middle c n) * (l - middle c n).

Lemma reach_below_sound : forall c n l x, reach_below n l c -> inside c x -> dot n x <= l.
Proof.
  intros c n l x [H Q] I. destruct (reach c x n I) as [_ L].
  specialize (L _ H Q). lra.
Qed.

Lemma relative : forall n x y t vA vB, dot n (sub x (scale t vA)) + dot (opp n) (sub y (scale t vB))
  = dot n (sub x y) - t * dot n (sub vA vB).
Proof. veq. Qed.

(* Two pieces that are farther apart than d. *)
Definition never (d : R) (a b : convex R) (v u : vec R) (h : horizon R) : Prop :=
  forall t x y, in_time h t -> inside_at a v t x -> inside_at b u t y -> d * d < dot (sub x y) (sub x y).

Lemma farther : forall n z d gap, 0 < gap -> d * d * dot n n < gap * gap -> gap <= - dot n z -> d * d < dot z z.
Proof.
  intros n z d gap G D H. pose proof (cauchy n z) as C. pose proof (dot_self n). pose proof (dot_self z).
  assert (gap * gap <= dot n z * dot n z) by nra.
  destruct (Rle_dec (dot z z) (d * d)); [|lra].
  assert (dot n n * dot z z <= dot n n * (d * d)) by (apply Rmult_le_compat_l; assumption). lra.
Qed.

(* A plane between bounds of both reaches. *)
Lemma apart_between_sound : forall d a b v u h n l m s,
  slides n (sub v u) h s -> (forall x, inside a x -> dot n x <= l) -> (forall x, inside b x -> dot (opp n) x <= - m) ->
  0 < m - l - s -> d * d * dot n n < (m - l - s) * (m - l - s) -> never d a b v u h.
Proof.
  intros d a b v u h n l m s S LA LB G D t x y T IA IB.
  pose proof (LA _ IA). pose proof (LB _ IB).
  pose proof (slide _ _ _ _ _ S T). pose proof (relative n x y t v u).
  apply (farther n _ d (m - l - s)); lra.
Qed.

(* A plane with normal n without bounds. *)
Lemma apart_along_sound : forall a b v u h n s,
  slides n (sub v u) h s -> beyond (- middle a n - middle b (opp n) - s) (bulge a n) (bulge b (opp n)) ->
  never 0 a b v u h.
Proof.
  intros a b v u h n s S B t x y T IA IB.
  destruct (reach_sqrt _ _ n IA) as [QA LA]. destruct (reach_sqrt _ _ (opp n) IB) as [QB LB].
  pose proof (beyond_roots _ _ _ QA QB B). pose proof (slide _ _ _ _ _ S T).
  pose proof (relative n x y t v u).
  assert (dot n (sub x y) < 0) by lra. rewrite Rmult_0_l.
  pose proof (cauchy n (sub x y)). pose proof (dot_self n). pose proof (dot_self (sub x y)).
  destruct (Req_dec (dot (sub x y) (sub x y)) 0) as [Z|Z]; [rewrite Z in *; nra|lra].
Qed.

Lemma out_sound : forall d k, (forall a b, In a (agent k) -> In b (obstacle k) -> never d a b (vA k) (vB k) (when k)) ->
  out d k.
Proof.
  intros d k H t x y T (a & IA & HA) (b & IB & HB). exact (H a b IA IB t x y T HA HB).
Qed.

(* A plane that leaves no more room than the two need. *)
Definition slips (a b : convex R) (v u : vec R) (h : horizon R) : Prop :=
  exists n, forall e t x, 0 < e -> in_time h t -> inside_at a v t (add x (scale e n)) -> ~ inside_at b u t x.

Lemma slips_sound : forall a b v u h n l m s,
  0 < dot n n -> slides n (sub v u) h s -> reach_below n l a -> reach_below (opp n) (- m) b -> 0 <= m - l - s ->
  slips a b v u h.
Proof.
  intros a b v u h n l m s N S LA LB G. exists n. intros e t x E T IA IB.
  pose proof (reach_below_sound _ _ _ _ LA IA). pose proof (reach_below_sound _ _ _ _ LB IB).
  pose proof (slide _ _ _ _ _ S T). pose proof (relative n (add x (scale e n)) x t v u) as Rel.
  replace (dot n (sub (add x (scale e n)) x)) with (e * dot n n) in Rel by veq.
  assert (0 < e * dot n n) by (apply Rmult_lt_0_compat; assumption). lra.
Qed.
