(* Errors of the obstacle's position and of the velocity within sets: apart for all of them; or there is one with which
   the two meet, and one with which they do not. *)
From Vericone Require Export Check.
Open Scope R_scope.

(* For all p of P and v of W: the obstacle, moved by p, and the agent, with the velocity v_A + v, are farther apart than d. *)
Definition out_for_all (d : R) (k : case R) (P W : convex R) : Prop :=
  forall p v, inside P p -> inside W v -> forall t x y, in_time (when k) t ->
  there (agent k) (add (vA k) v) t x -> there (obstacle k) (vB k) t (sub y p) -> d * d < dot (sub x y) (sub x y).

Definition never_for_all (d : R) (P W a b : convex R) (v u : vec R) (h : horizon R) : Prop :=
  forall p e, inside P p -> inside W e -> forall t x y, in_time h t ->
  inside_at a (add v e) t x -> inside_at b u t (sub y p) -> d * d < dot (sub x y) (sub x y).

Open Scope Q_scope.
Inductive error_proof :=
  | PlaneFor (n : normal) (l m position_l velocity_l : Q) (by_a by_b : option (list Q))
  | GroupsFor (of_agent : bool) (runs : list (Z * Z)) (proofs : list error_proof)
  | TimesFor (cuts : list Q) (proofs : list error_proof).

(* The greatest of t speed. *)
Definition slide_of (speed : Q) (h : horizon Q) : option Q :=
  match until h with
  | None => if le speed 0 then Some (from h * speed) else None
  | Some T => Some (maxq (from h * speed) (T * speed))
  end.
Lemma slide_of_real : forall speed h s t, slide_of speed h = Some s -> in_time (rh h) t -> (t * Q2R speed <= Q2R s)%R.
Proof.
  intros speed [t0 [t1|]] s t H [T0 T1]; unfold slide_of in H; cbn in *.
  - injection H as <-. rewrite Q2R_max, !Q2R_mult. rewrite Rmult_comm, (Rmult_comm (Q2R t0)), (Rmult_comm (Q2R t1)).
    apply product_max. lra.
  - destruct (le speed 0) eqn:E; [|discriminate H]. injection H as <-. apply le_real in E. rewrite Q2R_zero in E.
    rewrite Q2R_mult. nra.
Qed.

Definition plane_for (d : Q) (P W : convex Q) (A B : group) (w : vec Q) (h : horizon Q) (n : vec Q) (l m lp lw : Q)
    (ma mb : option (list Q)) : bool :=
  le 0 (from h) && reaches ma n l A && reaches mb (oppq n) (- m) B && reach_belowq (oppq n) lp P && reach_belowq n lw W &&
  match slide_of (dotq n w + lw) h with
  | None => false
  | Some s => let gap := m - l - lp - s in lt 0 gap && lt (d * d * dotq n n) (gap * gap)
  end.
Lemma plane_for_real : forall d P W A B v u h n l m lp lw ma mb a b,
  plane_for d P W A B (subq v u) h n l m lp lw ma mb = true -> In a A -> In b B ->
  never_for_all (Q2R d) (rc P) (rc W) (rc (snd a)) (rc (snd b)) (rv v) (rv u) (rh h).
Proof.
  intros d P W A B v u h n l m lp lw ma mb a b H IA IB p e Ip Ie t x y T XA XB. unfold plane_for in H.
  apply andb_prop in H. destruct H as [H G]. apply andb_prop in H. destruct H as [H HW].
  apply andb_prop in H. destruct H as [H HP]. apply andb_prop in H. destruct H as [H HB].
  apply andb_prop in H. destruct H as [F0 HA]. apply le_real in F0. rewrite Q2R_zero in F0.
  destruct (slide_of _ h) as [s|] eqn:S; [|discriminate G]. pose proof (slide_of_real _ _ _ _ S T) as Sl. cbv zeta in G.
  apply andb_prop in G. destruct G as [G D]. apply lt_real in G, D.
  rewrite Q2R_zero, !Q2R_minus in G. rewrite !Q2R_mult, !Q2R_minus, Q2R_dot in D.
  rewrite Q2R_plus, Q2R_dot, rv_sub in Sl.
  pose proof (reaches_real _ _ _ _ HA _ IA _ XA) as LA. pose proof (reaches_real _ _ _ _ HB _ IB _ XB) as LB.
  pose proof (reach_below_sound _ _ _ _ (reach_belowq_real _ _ _ HP) Ip) as LP.
  pose proof (reach_below_sound _ _ _ _ (reach_belowq_real _ _ _ HW) Ie) as LW.
  rewrite rv_opp in LB, LP. rewrite Q2R_opp in LB.
  assert (T0 : (0 <= t)%R) by (destruct T as [T _]; cbn in T; lra).
  apply (farther (rv n) _ (Q2R d) (Q2R m - Q2R l - Q2R lp - Q2R s)%R); [exact G|exact D|].
  assert (E : (dot (rv n) (sub x (scale t (add (rv v) e))) + dot (opp (rv n)) (sub (sub y p) (scale t (rv u)))
    = dot (rv n) (sub x y) - dot (opp (rv n)) p - t * (dot (rv n) (sub (rv v) (rv u)) + dot (rv n) e))%R)
    by (generalize (rv n) (rv v) (rv u); clear; veq).
  assert (t * dot (rv n) e <= t * Q2R lw)%R by (apply Rmult_le_compat_l; assumption).
  cbn [rh from] in *. lra.
Qed.

Fixpoint in_times_for (chk : horizon Q -> error_proof -> bool) (t0 : Q) (t1 : option Q) (cuts : list Q)
    (proofs : list error_proof) : bool :=
  match cuts, proofs with
  | [], [p] => chk (Horizon t0 t1) p
  | c :: cuts, p :: proofs =>
      lt t0 c && match t1 with None => true | Some T => lt c T end &&
      chk (Horizon t0 (Some c)) p && in_times_for chk c t1 cuts proofs
  | _, _ => false
  end.
Lemma in_times_for_sound : forall (chk : horizon Q -> error_proof -> bool) (P : R -> Prop),
  (forall h p, chk h p = true -> forall t, in_time (rh h) t -> P t) ->
  forall cuts proofs t0 t1, in_times_for chk t0 t1 cuts proofs = true -> forall t, in_time (rh (Horizon t0 t1)) t -> P t.
Proof.
  intros chk P Sound. induction cuts as [|c cuts IH]; intros [|p proofs] t0 t1 H t T; try discriminate H.
  - destruct proofs; [|discriminate H]. exact (Sound _ _ H t T).
  - cbn [in_times_for] in H. apply andb_prop in H. destruct H as [H R]. apply andb_prop in H. destruct H as [H F].
    destruct (Rle_dec t (Q2R c)) as [L|L].
    + apply (Sound _ _ F). destruct T as [T _]. split; [exact T|exact L].
    + apply (IH _ _ _ R). destruct T as [_ T]. split; [cbn; lra|exact T].
Qed.

Fixpoint check_for (fuel : nat) (d : Q) (P W : convex Q) (v u : vec Q) (A B : group) (h : horizon Q) (p : error_proof) : bool :=
  match fuel with
  | O => false
  | S fuel =>
      match p with
      | PlaneFor n l m lp lw ma mb => let w := subq v u in plane_for d P W A B w h (direction n w) l m lp lw ma mb
      | GroupsFor true runs proofs => in_groups (fun g p => check_for fuel d P W v u g B h p) runs proofs A
      | GroupsFor false runs proofs => in_groups (fun g p => check_for fuel d P W v u A g h p) runs proofs B
      | TimesFor cuts proofs => in_times_for (fun h p => check_for fuel d P W v u A B h p) (from h) (until h) cuts proofs
      end
  end.
Lemma check_for_real : forall fuel d P W v u A B h p, check_for fuel d P W v u A B h p = true ->
  forall a b, In a A -> In b B -> never_for_all (Q2R d) (rc P) (rc W) (rc (snd a)) (rc (snd b)) (rv v) (rv u) (rh h).
Proof.
  induction fuel as [|fuel IH]; intros d P W v u A B h p H a b IA IB; [discriminate H|].
  destruct p as [n l m lp lw ma mb|[] runs proofs|cuts proofs]; cbn [check_for] in H.
  - apply (plane_for_real _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ H IA IB).
  - destruct (in_groups_all _ _ _ _ _ a H IA) as (s & p & X & _ & F). apply (IH _ _ _ _ _ _ _ _ _ F _ _ X IB).
  - destruct (in_groups_all _ _ _ _ _ b H IB) as (s & p & X & _ & F). apply (IH _ _ _ _ _ _ _ _ _ F _ _ IA X).
  - intros p e Ip Ie t x y T. destruct h as [t0 t1].
    apply (in_times_for_sound _ (fun t => inside_at (rc (snd a)) (add (rv v) e) t x -> inside_at (rc (snd b)) (rv u) t (sub y p) ->
      (Q2R d * Q2R d < dot (sub x y) (sub x y))%R)
      (fun h q F t T => IH d P W v u A B h q F a b IA IB p e Ip Ie t x y T) _ _ _ _ H t T).
Qed.

Definition check_errors (d : Q) (k : case Q) (P W : convex Q) (p : error_proof) : bool :=
  le 0 d && well_formed_case k && well_formed_piece P && well_formed_piece W &&
  check_for depth d P W (vA k) (vB k) (numbered 0 (agent k)) (numbered 0 (obstacle k)) (when k) p.
Theorem check_errors_sound : forall d k P W p, check_errors d k P W p = true ->
  out_for_all (Q2R d) (rk k) (rc P) (rc W).
Proof.
  intros d k P W p H e f Ie If t x y T (a & IA & HA) (b & IB & HB). unfold check_errors in H.
  apply andb_prop in H. destruct H as [_ H]. apply of_numbered in IA, IB.
  destruct IA as (na & IA & ->). destruct IB as (nb & IB & ->).
  apply (check_for_real _ _ _ _ _ _ _ _ _ _ H na nb IA IB e f Ie If t x y T HA HB).
Qed.

(* The same, moved. *)
Fixpoint moved (p : vec R) (c : convex R) : convex R :=
  match c with
  | Ellipsoid c F => Ellipsoid (add p c) F
  | Shaped c M => Shaped (add p c) M
  | Ball c r => Ball (add p c) r
  | Box lo hi => Box (add p lo) (add p hi)
  | Hull ps => Hull (map (add p) ps)
  | Cut c q A l => Cut (moved p c) (add p q) A l
  end.
(* The obstacle moved by p, the agent's velocity changed by v. *)
Definition with_error (p v : vec R) (k : case R) : case R :=
  Case (agent k) (map (moved p) (obstacle k)) (add (vA k) v) (vB k) (when k).
Definition depends (k : case R) (P W : convex R) : Prop :=
  (exists p v, inside P p /\ inside W v /\ in_cone (with_error p v k)) /\
  (exists p v, inside P p /\ inside W v /\ out 0 (with_error p v k)).

(* What is moved is what it was, elsewhere. *)
Lemma mean_moved : forall p ps ws, length ws = length ps ->
  mean ws (map (add p) ps) = add (scale (total ws) p) (mean ws ps).
Proof.
  intros p. induction ps as [|q ps IH]; intros [|w ws] L; try discriminate L; [cbn; veq|].
  cbn [mean map]. rewrite IH by (injection L; auto). unfold total. cbn [fold_right].
  generalize (fold_right Rplus 0%R ws) (mean ws ps). clear. intros t m. veq.
Qed.
Lemma inside_moved : forall p c x, inside c x -> inside (moved p c) (add p x).
Proof.
  intros p. induction c as [c F|c M|c r|lo hi|ps|c IH q A l]; intros x I; cbn [moved inside] in *.
  - destruct I as (u & U & ->). exists u. split; [exact U|]. generalize (mul F u). clear. intros m. veq.
  - intros n. replace (sub (add p x) (add p c)) with (sub x c) by (clear; veq). apply I.
  - destruct I as [R I]. split; [exact R|]. replace (sub (add p x) (add p c)) with (sub x c) by (clear; veq). exact I.
  - destruct p as [a b d], x as [e f g], lo as [h i j], hi as [k l m]. cbn [add vx vy vz] in *. lra.
  - destruct I as (ws & L & W & T & ->). exists ws. rewrite map_length. repeat (split; [assumption|]).
    rewrite mean_moved, T by exact L. generalize (mean ws ps). clear. intros m. veq.
  - destruct I as [I K]. split; [apply IH, I|]. replace (sub (add p x) (add p q)) with (sub x q) by (clear; veq). exact K.
Qed.

Fixpoint movedq (p : vec Q) (c : convex Q) : convex Q :=
  match c with
  | Ellipsoid c F => Ellipsoid (addq p c) F
  | Shaped c M => Shaped (addq p c) M
  | Ball c r => Ball (addq p c) r
  | Box lo hi => Box (addq p lo) (addq p hi)
  | Hull ps => Hull (map (addq p) ps)
  | Cut c q A l => Cut (movedq p c) (addq p q) A l
  end.
Definition with_errorq (p v : vec Q) (k : case Q) : case Q :=
  Case (agent k) (map (movedq p) (obstacle k)) (addq (vA k) v) (vB k) (when k).
Lemma rc_moved : forall p c, rc (movedq p c) = moved (rv p) (rc c).
Proof.
  intros p. induction c as [c F|c M|c r|lo hi|ps|c IH q A l]; cbn [movedq moved rc]; rewrite ?rv_add; try reflexivity.
  - rewrite !map_map. f_equal. apply map_ext. intros q. apply rv_add.
  - rewrite IH. reflexivity.
Qed.
Lemma rk_with_error : forall p v k, rk (with_errorq p v k) = with_error (rv p) (rv v) (rk k).
Proof.
  intros p v k. unfold rk, with_errorq, with_error. cbn [agent obstacle vA vB when]. rewrite rv_add, !map_map.
  f_equal. apply map_ext. intros c. apply rc_moved.
Qed.

(* An error of each kind: of the position, of the velocity, and what proves it. *)
Definition check_one (says : case Q -> claim) (k : case Q) (P W : convex Q) (e : vec Q * vec Q * proof) : bool :=
  let '(p, v, its) := e in member false P [] p && member false W [] v && check (says (with_errorq p v k)) its.
Definition check_depends (k : case Q) (P W : convex Q) (collides passes : vec Q * vec Q * proof) : bool :=
  check_one InCone k P W collides && check_one (Out 0) k P W passes.
Theorem check_depends_sound : forall k P W c p, check_depends k P W c p = true -> depends (rk k) (rc P) (rc W).
Proof.
  intros k P W c p H. unfold check_depends in H. apply andb_prop in H. destruct H as [C O].
  assert (One : forall says e, check_one says k P W e = true -> exists p v, inside (rc P) (rv p) /\ inside (rc W) (rv v) /\
    meaning (says (with_errorq p v k))).
  { intros says [[q v] its] K. cbn [check_one] in K. apply andb_prop in K. destruct K as [K S]. apply andb_prop in K.
    destruct K as [IP IW]. apply member_inside in IP, IW. exists q, v. split; [apply IP|]. split; [apply IW|].
    apply (check_sound _ _ S). }
  destruct (One _ _ C) as (q & v & IP & IW & M). destruct (One _ _ O) as (q' & v' & IP' & IW' & M').
  cbn [meaning] in M, M'. rewrite rk_with_error in M, M'. rewrite Q2R_zero in M'. split.
  - exists (rv q), (rv v). auto.
  - exists (rv q'), (rv v'). auto.
Qed.
