(* The checker of verdicts and its theorem: what it accepts is true. *)
From Vericone Require Export Boxes.
Open Scope Q_scope.

Inductive claim :=
  | Out (by_more_than : Q) (k : case Q)
  | InCone (k : case Q)
  | OnCone (k : case Q).

(* What is claimed, of sets of reals. *)
Definition meaning (c : claim) : Prop :=
  match c with
  | Out d k => out (Q2R d) (rk k)
  | InCone k => in_cone (rk k)
  | OnCone k => on_cone (rk k)
  end.

Inductive normal :=
  | Given (n : vec Q)
  | AcrossX (a b : Q) | AcrossY (a b : Q) | AcrossZ (a b : Q). (* perpendicular to w *)

Record place := Place { piece : Z; weights : places }.

Inductive proof :=
  | Plane (n : normal) (bounds : option (Q * Q)) (by_a by_b : option (list Q)) (* multipliers *)
  | Touch (n : vec Q) (time : Q) (point : vec Q) (a b : place)
  | Point (time : Q) (point : vec Q) (in_agent : bool) (a b : place)
  | Cross (time : Q) (pairs : list (Z * Z * Q)) (a b : Z)
  | Groups (of_agent : bool) (runs : list (Z * Z)) (proofs : list proof)
  | Times (cuts : list Q) (proofs : list proof)
  | Forms (of_a of_b : list Q) (products : list (factor * factor * Q))
  | Halves (n : vec Q) (at_ : Q) (below_it above_it : proof)
  | Cover (of_agent : bool) (boxes : list (vec Q * vec Q)) (runs : list (Z * Z)) (p : proof).

(* Pieces with their numbers; what an enclosing Groups has left of them. *)
Definition group := list (Z * convex Q).
Fixpoint numbered {T : Type} (k : Z) (l : list T) : list (Z * T) :=
  match l with [] => [] | x :: l => (k, x) :: numbered (k + 1) l end.
Fixpoint find (g : group) (k : Z) : option (convex Q) :=
  match g with [] => None | (j, c) :: g => if (j =? k)%Z then Some c else find g k end.

Lemma numbered_in : forall T (l : list T) k j x, In (j, x) (numbered k l) -> In x l.
Proof.
  induction l as [|y l IH]; intros k j x H; [destruct H|]. destruct H as [H|H].
  - injection H as _ <-. left; reflexivity.
  - right. apply (IH _ _ _ H).
Qed.
Lemma in_numbered : forall T (l : list T) k x, In x l -> exists j, In (j, x) (numbered k l).
Proof.
  induction l as [|y l IH]; intros k x H; [destruct H|]. destruct H as [->|H].
  - exists k. left; reflexivity.
  - destruct (IH (k + 1)%Z x H) as [j J]. exists j. right. exact J.
Qed.
Lemma numbered_at : forall T (l : list T) k j, (k <= j < k + Z.of_nat (length l))%Z -> exists x, In (j, x) (numbered k l).
Proof.
  induction l as [|y l IH]; intros k j H; [cbn in H; lia|].
  destruct (Z.eq_dec j k) as [->|N].
  - exists y. left; reflexivity.
  - destruct (IH (k + 1)%Z j) as [x X]; [cbn [length] in H; lia|]. exists x. right. exact X.
Qed.
Lemma find_in : forall g k c, find g k = Some c -> In c (map snd g).
Proof.
  induction g as [|[j d] g IH]; intros k c H; [discriminate H|]. cbn in H.
  destruct (j =? k)%Z; [injection H as <-; left; reflexivity | right; apply (IH _ _ H)].
Qed.

(* Runs deal the pieces out in their order. *)
Fixpoint take (n : Z) (g : group) : option (group * group) :=
  if (n <=? 0)%Z then Some ([], g) else
  match g with
  | [] => None
  | x :: g => match take (n - 1) g with Some (a, b) => Some (x :: a, b) | None => None end
  end.
Fixpoint deal (runs : list (Z * Z)) (g : group) : option (list (Z * group)) :=
  match runs with
  | [] => match g with [] => Some [] | _ => None end
  | (k, n) :: runs =>
      if (n <? 1)%Z then None else
      match take n g with
      | None => None
      | Some (a, g) => match deal runs g with Some d => Some ((k, a) :: d) | None => None end
      end
  end.
Definition share (k : Z) (dealt : list (Z * group)) : group :=
  flat_map (fun d => if (fst d =? k)%Z then snd d else []) dealt.

Lemma take_all : forall g n a b x, take n g = Some (a, b) -> In x g -> In x a \/ In x b.
Proof.
  induction g as [|y g IH]; intros n a b x H I; cbn in H; destruct (n <=? 0)%Z; try discriminate H.
  - destruct I.
  - injection H as <- <-. right; exact I.
  - destruct (take (n - 1) g) as [[a' b']|] eqn:E; [|discriminate H]. injection H as <- <-.
    destruct I as [->|I]; [left; left; reflexivity|]. destruct (IH _ _ _ x E I); [left; right|right]; assumption.
Qed.
Lemma take_part : forall g n a b x, take n g = Some (a, b) -> In x a \/ In x b -> In x g.
Proof.
  induction g as [|y g IH]; intros n a b x H I; cbn in H; destruct (n <=? 0)%Z; try discriminate H.
  - injection H as <- <-. destruct I as [[]|I]; exact I.
  - injection H as <- <-. destruct I as [[]|I]; exact I.
  - destruct (take (n - 1) g) as [[a' b']|] eqn:E; [|discriminate H]. injection H as <- <-.
    destruct I as [[->|I]|I]; [left; reflexivity | right; apply (IH _ _ _ x E); left; exact I
      | right; apply (IH _ _ _ x E); right; exact I].
Qed.
Lemma deal_all : forall runs g d x, deal runs g = Some d -> In x g -> exists k a, In (k, a) d /\ In x a.
Proof.
  induction runs as [|[k n] runs IH]; intros g d x H I; cbn in H.
  - destruct g; [destruct I|discriminate H].
  - destruct (n <? 1)%Z; [discriminate H|]. destruct (take n g) as [[a b]|] eqn:E; [|discriminate H].
    destruct (deal runs b) as [d'|] eqn:F; [|discriminate H]. injection H as <-.
    destruct (take_all _ _ _ _ x E I) as [A|B].
    + exists k, a. split; [left; reflexivity|exact A].
    + destruct (IH _ _ x F B) as (j & c & J & C). exists j, c. split; [right; exact J|exact C].
Qed.
Lemma deal_part : forall runs g d k a x, deal runs g = Some d -> In (k, a) d -> In x a -> In x g.
Proof.
  induction runs as [|[j n] runs IH]; intros g d k a x H I X; cbn in H.
  - destruct g; [injection H as <-; destruct I|discriminate H].
  - destruct (n <? 1)%Z; [discriminate H|]. destruct (take n g) as [[c b]|] eqn:E; [|discriminate H].
    destruct (deal runs b) as [d'|] eqn:F; [|discriminate H]. injection H as <-.
    apply (take_part _ _ _ _ x E). destruct I as [I|I].
    + injection I as _ <-. left; exact X.
    + right. apply (IH _ _ _ _ _ F I X).
Qed.
Lemma share_in : forall d k a x, In (k, a) d -> In x a -> In x (share k d).
Proof.
  intros d k a x I X. apply in_flat_map. exists (k, a). split; [exact I|]. cbn. rewrite Z.eqb_refl. exact X.
Qed.
Lemma in_share : forall d k x, In x (share k d) -> exists a, In (k, a) d /\ In x a.
Proof.
  intros d k x H. apply in_flat_map in H. destruct H as ([j a] & I & X). cbn in X.
  destruct (j =? k)%Z eqn:E; [|destruct X]. apply Z.eqb_eq in E. subst. exists a. split; assumption.
Qed.

(* The groups are divided; chk holds of each proof and its share. *)
Definition in_groups {P : Type} (chk : group -> P -> bool) (runs : list (Z * Z)) (proofs : list P) (g : group) : bool :=
  match deal runs g with
  | None => false
  | Some d =>
      forallb (fun r => (0 <=? fst r)%Z && (fst r <? Z.of_nat (length proofs))%Z) d &&
      forallb (fun kp => let s := share (fst kp) d in
        match s with [] => false | _ => chk s (snd kp) end) (numbered 0 proofs)
  end.
Lemma in_groups_all : forall P (chk : group -> P -> bool) runs proofs g x, in_groups chk runs proofs g = true -> In x g ->
  exists s p, In x s /\ In p proofs /\ chk s p = true.
Proof.
  intros P chk runs proofs g x H X. unfold in_groups in H. destruct (deal runs g) as [d|] eqn:E; [|discriminate H].
  apply andb_prop in H. destruct H as [R F]. rewrite forallb_forall in R, F.
  destruct (deal_all _ _ _ x E X) as (k & a & K & A). specialize (R _ K). cbn [fst] in R.
  apply andb_prop in R. destruct R as [R1 R2]. apply Z.leb_le in R1. apply Z.ltb_lt in R2.
  destruct (numbered_at _ proofs 0 k) as [p I]; [lia|]. specialize (F _ I). cbn [fst snd] in F.
  exists (share k d), p. pose proof (share_in _ _ _ x K A) as S. split; [exact S|].
  split; [apply (numbered_in _ _ _ _ _ I)|]. destruct (share k d); [destruct S|exact F].
Qed.
Lemma in_groups_each : forall P (chk : group -> P -> bool) runs proofs g p, in_groups chk runs proofs g = true -> In p proofs ->
  exists s, chk s p = true /\ s <> [] /\ forall x, In x s -> In x g.
Proof.
  intros T chk runs proofs g p H P. unfold in_groups in H. destruct (deal runs g) as [d|] eqn:E; [|discriminate H].
  apply andb_prop in H. destruct H as [_ F]. rewrite forallb_forall in F.
  destruct (in_numbered _ proofs 0 p P) as [k K]. specialize (F _ K). cbn [fst snd] in F.
  exists (share k d). destruct (share k d) as [|y s] eqn:S; [discriminate F|]. split; [exact F|]. split; [discriminate|].
  intros x X. rewrite <- S in X. destruct (in_share _ _ _ X) as (a & A & XA). apply (deal_part _ _ _ _ _ _ E A XA).
Qed.

(* Boxes that stand for the pieces that they hold. *)
Definition covers (g : group) (b : vec Q * vec Q) : bool := forallb (fun c => in_box (snd c) (fst b) (snd b)) g.
Definition box_of (b : vec Q * vec Q) : convex Q := Box (fst b) (snd b).
Lemma covered_real : forall runs boxes g c, in_groups covers runs boxes g = true -> In c g ->
  exists k : Z * convex Q, In k (numbered 0 (map box_of boxes)) /\ forall x, inside (rc (snd c)) x -> inside (rc (snd k)) x.
Proof.
  intros runs boxes g c H I. destruct (in_groups_all _ _ _ _ _ c H I) as (s & b & X & B & F).
  unfold covers in F. rewrite forallb_forall in F. specialize (F c X).
  destruct (in_numbered _ (map box_of boxes) 0%Z (box_of b)) as [j J]; [apply in_map, B|].
  exists (j, box_of b). split; [exact J|]. cbn [snd]. apply in_box_real, F.
Qed.

(* A horizon in parts. *)
Fixpoint in_times (chk : horizon Q -> proof -> bool) (t0 : Q) (t1 : option Q) (cuts : list Q) (proofs : list proof) : bool :=
  match cuts, proofs with
  | [], [p] => chk (Horizon t0 t1) p
  | c :: cuts, p :: proofs =>
      lt t0 c && match t1 with None => true | Some T => lt c T end &&
      chk (Horizon t0 (Some c)) p && in_times chk c t1 cuts proofs
  | _, _ => false
  end.

(* Planes. *)
Definition direction (n : normal) (w : vec Q) : vec Q :=
  match n with
  | Given n => n
  | AcrossX a b => Vec (- (a * vy w) - b * vz w) (a * vx w) (b * vx w)
  | AcrossY a b => Vec (a * vy w) (- (a * vx w) - b * vz w) (b * vy w)
  | AcrossZ a b => Vec (a * vz w) (b * vz w) (- (a * vx w) - b * vy w)
  end.
Definition reaches (ms : option (list Q)) (n : vec Q) (l : Q) (g : group) : bool :=
  match ms, g with
  | None, g => forallb (fun a => reach_belowq n l (snd a)) g
  | Some ms, [a] => reach_by ms n l (snd a)
  | Some _, _ => false
  end.
Lemma reaches_real : forall ms n l g, reaches ms n l g = true ->
  forall a, In a g -> forall x, inside (rc (snd a)) x -> (dot (rv n) x <= Q2R l)%R.
Proof.
  intros [ms|] n l g H a I x X.
  - destruct g as [|b [|c g]]; try discriminate H. destruct I as [->|[]]. apply (reach_by_real _ _ _ _ H _ X).
  - cbn in H. rewrite forallb_forall in H. specialize (H _ I). apply reach_belowq_real in H.
    apply (reach_below_sound _ _ _ _ H X).
Qed.

Definition plane_out (d : Q) (A B : group) (w : vec Q) (h : horizon Q) (n : vec Q) (bounds : option (Q * Q))
    (ma mb : option (list Q)) : bool :=
  match slideq n w h with
  | None => false
  | Some s =>
      let o := oppq n in
      match bounds with
      | Some (l, m) =>
          let gap := m - l - s in
          lt 0 gap && lt (d * d * dotq n n) (gap * gap) &&
          reaches ma n l A && reaches mb o (- m) B
      | None =>
          eq d 0 &&
          (let As := map (fun a => (middleq (snd a) n, bulgeq (snd a) n)) A in
           let Bs := map (fun b => (middleq (snd b) o, bulgeq (snd b) o)) B in
           forallb (fun a => forallb (fun b => beyondq (- fst a - fst b - s) (snd a) (snd b)) Bs) As)
      end
  end.

Lemma plane_out_real : forall d A B v u h n bounds ma mb a b, plane_out d A B (subq v u) h n bounds ma mb = true ->
  In a A -> In b B -> never (Q2R d) (rc (snd a)) (rc (snd b)) (rv v) (rv u) (rh h).
Proof.
  intros d A B v u h n bounds ma mb a b H IA IB. unfold plane_out in H.
  destruct (slideq n (subq v u) h) as [s|] eqn:S; [|discriminate H].
  apply slideq_real in S. rewrite rv_sub in S. destruct bounds as [[l m]|].
  - cbv zeta in H. apply andb_prop in H. destruct H as [H HB]. apply andb_prop in H. destruct H as [H HA].
    pose proof (reaches_real _ _ _ _ HA _ IA) as LA. pose proof (reaches_real _ _ _ _ HB _ IB) as LB.
    clear HA HB. rewrite rv_opp, Q2R_opp in LB. real.
    apply (apart_between_sound _ _ _ _ _ _ (rv n) (Q2R l) (Q2R m) (Q2R s)); assumption.
  - apply andb_prop in H. destruct H as [D H]. apply eq_real in D. rewrite Q2R_zero in D. rewrite D. cbv zeta in H.
    rewrite forallb_forall in H.
    specialize (H _ (in_map (fun a => (middleq (snd a) n, bulgeq (snd a) n)) _ _ IA)).
    rewrite forallb_forall in H.
    specialize (H _ (in_map (fun b => (middleq (snd b) (oppq n), bulgeq (snd b) (oppq n))) _ _ IB)).
    cbn [fst snd] in H. apply beyondq_real in H.
    rewrite !Q2R_minus, Q2R_opp, !Q2R_middle, !Q2R_bulge, rv_opp in H.
    apply (apart_along_sound _ _ _ _ _ (rv n) (Q2R s)); assumption.
Qed.

(* Of one piece each, by forms, the space cut in halves. *)
Fixpoint dent_out (fuel : nat) (a b : convex Q) (w : vec Q) (h : horizon Q) (cuts : list cut) (p : proof) : bool :=
  match fuel with
  | O => false
  | S fuel =>
      match p with
      | Forms ms ns ps => forms_out a b w h cuts ms ns ps
      | Halves n s p q => dent_out fuel a b w h (cuts ++ [CutAt n s true]) p && dent_out fuel a b w h (cuts ++ [CutAt n s false]) q
      | _ => false
      end
  end.
Lemma dent_out_real : forall fuel a b w h cuts p, dent_out fuel a b w h cuts p = true -> forall y t, ~ shared a b w h cuts y t.
Proof.
  induction fuel as [|fuel IH]; intros a b w h cuts p H y t C; [discriminate H|]. cbn [dent_out] in H.
  destruct p; try discriminate H; [apply (forms_out_real _ _ _ _ _ _ _ _ H _ _ C)|].
  apply andb_prop in H. destruct H as [B A]. destruct C as (T & IA & IB & F).
  assert (Both : forall side, cut_holds (CutAt n at_ side) y -> shared a b w h (cuts ++ [CutAt n at_ side]) y t).
  { intros side K. repeat (split; [assumption|]). apply Forall_app. split; [exact F|]. constructor; [exact K|constructor]. }
  destruct (Rle_dec (dot (rv n) y) (Q2R at_)) as [L|L].
  - apply (IH _ _ _ _ _ _ B y t), Both. exact L.
  - apply (IH _ _ _ _ _ _ A y t), Both. cbn. lra.
Qed.

(* out: fuel bounds the nesting. *)
Fixpoint check_out (fuel : nat) (d : Q) (v u : vec Q) (A B : group) (h : horizon Q) (p : proof) : bool :=
  match fuel with
  | O => false
  | S fuel =>
      match p with
      | Plane n bounds ma mb => let w := subq v u in plane_out d A B w h (direction n w) bounds ma mb
      | Groups true runs proofs => in_groups (fun g p => check_out fuel d v u g B h p) runs proofs A
      | Groups false runs proofs => in_groups (fun g p => check_out fuel d v u A g h p) runs proofs B
      | Times cuts proofs => in_times (fun h p => check_out fuel d v u A B h p) (from h) (until h) cuts proofs
      | Cover true boxes runs p => in_groups covers runs boxes A && check_out fuel d v u (numbered 0 (map box_of boxes)) B h p
      | Cover false boxes runs p => in_groups covers runs boxes B && check_out fuel d v u A (numbered 0 (map box_of boxes)) h p
      | Forms _ _ _ | Halves _ _ _ _ =>
          match A, B with [a], [b] => eq d 0 && dent_out fuel (snd a) (snd b) (subq v u) h [] p | _, _ => false end
      | _ => false
      end
  end.

Lemma in_times_sound : forall (chk : horizon Q -> proof -> bool) (P : R -> Prop),
  (forall h p, chk h p = true -> forall t, in_time (rh h) t -> P t) ->
  forall cuts proofs t0 t1, in_times chk t0 t1 cuts proofs = true -> forall t, in_time (rh (Horizon t0 t1)) t -> P t.
Proof.
  intros chk P Sound. induction cuts as [|c cuts IH]; intros [|p proofs] t0 t1 H t T; try discriminate H.
  - destruct proofs; [|discriminate H]. exact (Sound _ _ H t T).
  - cbn [in_times] in H. apply andb_prop in H. destruct H as [H R]. apply andb_prop in H. destruct H as [H F].
    destruct (Rle_dec t (Q2R c)) as [L|L].
    + apply (Sound _ _ F). destruct T as [T _]. split; [exact T|exact L].
    + apply (IH _ _ _ R). destruct T as [_ T]. split; [cbn; lra|exact T].
Qed.

Lemma check_out_real : forall fuel d v u A B h p, check_out fuel d v u A B h p = true ->
  forall a b, In a A -> In b B -> never (Q2R d) (rc (snd a)) (rc (snd b)) (rv v) (rv u) (rh h).
Proof.
  induction fuel as [|fuel IH]; intros d v u A B h p H a b IA IB; [discriminate H|].
  assert (Dent : match A, B with [a], [b] => eq d 0 && dent_out fuel (snd a) (snd b) (subq v u) h [] p | _, _ => false end = true ->
    never (Q2R d) (rc (snd a)) (rc (snd b)) (rv v) (rv u) (rh h)).
  { intros D. destruct A as [|a' [|]]; try discriminate D. destruct B as [|b' [|]]; try discriminate D.
    destruct IA as [->|[]]. destruct IB as [->|[]]. apply andb_prop in D. destruct D as [E D].
    apply eq_real in E. rewrite E, Q2R_zero. intros t x y T XA XB. rewrite Rmult_0_l.
    pose proof (dot_self (sub x y)). destruct (Req_dec (dot (sub x y) (sub x y)) 0) as [Z|Z]; [exfalso|lra].
    assert (S0 : sub x y = zero) by (apply dot_self_zero; lra).
    assert (XY : x = y).
    { transitivity (add (sub x y) y); [clear; veq|]. rewrite S0. clear; veq. }
    subst y. apply (dent_out_real _ _ _ _ _ _ _ D (sub x (scale t (rv u))) t). split; [exact T|]. split; [|split; [exact XB|constructor]].
    rewrite rv_sub. replace (sub (sub x (scale t (rv u))) (scale t (sub (rv v) (rv u)))) with (sub x (scale t (rv v)))
      by (generalize (rv v) (rv u); clear; veq). exact XA. }
  destruct p as [n bounds ma mb|n t x pa pb|t x s pa pb|t prs pa pb|[] runs proofs|cuts proofs|ms ns ps|n s p q|[] boxes runs p]; try discriminate H;
    [| | | |exact (Dent H)|exact (Dent H)| |]; clear Dent.
  - apply (plane_out_real _ _ _ _ _ _ _ _ _ _ _ _ H IA IB).
  - destruct (in_groups_all _ _ _ _ _ a H IA) as (s & p & X & _ & F). apply (IH _ _ _ _ _ _ _ F _ _ X IB).
  - destruct (in_groups_all _ _ _ _ _ b H IB) as (s & p & X & _ & F). apply (IH _ _ _ _ _ _ _ F _ _ IA X).
  - intros t x y T. destruct h as [t0 t1].
    apply (in_times_sound _ (fun t => inside_at (rc (snd a)) (rv v) t x -> inside_at (rc (snd b)) (rv u) t y ->
      (Q2R d * Q2R d < dot (sub x y) (sub x y))%R) (fun h p F t T => IH d v u A B h p F a b IA IB t x y T) _ _ _ _ H t T).
  - apply andb_prop in H. destruct H as [H K]. destruct (covered_real _ _ _ _ H IA) as (k & Ik & S).
    intros t x y T X. apply (IH _ _ _ _ _ _ _ K k b Ik IB t x y T), S, X.
  - apply andb_prop in H. destruct H as [H K]. destruct (covered_real _ _ _ _ H IB) as (k & Ik & S).
    intros t x y T X Y. apply (IH _ _ _ _ _ _ _ K a k IA Ik t x y T X), S, Y.
Qed.

(* Corners: of a box, of a ball of radius 0 too. *)
Definition corners (c : convex Q) : list (vec Q) :=
  match c with
  | Hull ps => ps
  | Box (Vec a b c) (Vec x y z) =>
      [Vec a b c; Vec x b c; Vec a y c; Vec x y c; Vec a b z; Vec x b z; Vec a y z; Vec x y z]
  | Ball p r => if eq r 0 then [p] else []
  | _ => []
  end.
Fixpoint well_formed_piece (c : convex Q) : bool :=
  match c with
  | Ellipsoid _ _ => true
  | Shaped _ M => positive_shapeq M
  | Ball _ r => le 0 r
  | Box lo hi => ordered lo hi
  | Hull ps => match ps with [] => false | _ => true end
  | Cut c _ A _ => well_formed_piece c && eq (vy (r1 A)) (vx (r2 A)) && eq (vz (r1 A)) (vx (r3 A)) &&
      eq (vz (r2 A)) (vy (r3 A))
  end.

Ltac ends := let p := fresh in let P := fresh in
  intros p P; repeat (destruct P as [<-|P]; [cbn; lra|]); destruct P.
Lemma corners_inside : forall c x, well_formed_piece c = true -> inside (Hull (map rv (corners c))) x -> inside (rc c) x.
Proof.
  intros [p F|p M|p r|[a b c] [a' b' c']|ps|c p A l] x W H; cbn [corners] in H.
  - destruct H as ([|w ws] & L & _ & T & _); [cbn in T; lra|discriminate L].
  - destruct H as ([|w ws] & L & _ & T & _); [cbn in T; lra|discriminate L].
  - destruct (eq r 0) eqn:E.
    + destruct H as ([|w [|w' ws]] & L & _ & T & ->); try discriminate L.
      apply eq_real in E. rewrite Q2R_zero in E. cbn in T. cbn [rc inside map mean]. rewrite E. split; [lra|].
      replace w with 1%R by lra. replace (sub (add (scale 1 (rv p)) zero) (rv p)) with zero by (generalize (rv p); clear; veq).
      unfold zero, dot. cbn. lra.
    + destruct H as ([|w ws] & L & _ & T & _); [cbn in T; lra|discriminate L].
  - unfold well_formed_piece, ordered in W. cbn in W. real.
    assert (Bound : forall n l, (forall p, In p (map rv [Vec a b c; Vec a' b c; Vec a b' c; Vec a' b' c; Vec a b c';
      Vec a' b c'; Vec a b' c'; Vec a' b' c']) -> (dot n p <= l)%R) -> (dot n x <= l)%R).
    { intros n l G. apply (hull_between n l _ x H G). }
    pose proof (Bound (Vec 1 0 0)%R (Q2R a')) as X1. pose proof (Bound (Vec (-1) 0 0)%R (- Q2R a)%R) as X2.
    pose proof (Bound (Vec 0 1 0)%R (Q2R b')) as Y1. pose proof (Bound (Vec 0 (-1) 0)%R (- Q2R b)%R) as Y2.
    pose proof (Bound (Vec 0 0 1)%R (Q2R c')) as Z1. pose proof (Bound (Vec 0 0 (-1))%R (- Q2R c)%R) as Z2.
    destruct x as [x y z]. unfold dot, rv in *. cbn in *.
    assert (X1' := X1 ltac:(ends)).
    assert (X2' := X2 ltac:(ends)).
    assert (Y1' := Y1 ltac:(ends)).
    assert (Y2' := Y2 ltac:(ends)).
    assert (Z1' := Z1 ltac:(ends)).
    assert (Z2' := Z2 ltac:(ends)).
    lra.
  - exact H.
  - destruct H as ([|w ws] & L & _ & T & _); [cbn in T; lra|discriminate L].
Qed.

(* A point of a piece: by its inequalities, or as a mean of its corners. *)
Definition member (strictly : bool) (c : convex Q) (s : places) (x : vec Q) : bool :=
  match s with
  | [] => memberq strictly c [] x
  | _ => well_formed_piece c && memberq strictly (Hull (corners c)) s x
  end.
Lemma member_inside : forall strictly c s x, member strictly c s x = true ->
  inside (rc c) (rv x) /\ (strictly = true -> interior (rc c) (rv x)).
Proof.
  intros strictly c [|w s] x H; cbn [member] in H; [apply (memberq_inside _ _ _ _ H)|].
  apply andb_prop in H. destruct H as [W H]. apply memberq_inside in H. destruct H as [I S].
  split; [apply corners_inside; assumption|]. intros T. destruct (S T) as (e & E & N). exists e. split; [exact E|].
  intros h Hh. apply corners_inside; [exact W|]. apply (N h Hh).
Qed.

(* on *)
Definition member_at (strictly : bool) (g : group) (p : place) (v : vec Q) (t : Q) (x : vec Q) : bool :=
  match find g (piece p) with
  | None => false
  | Some c => member strictly c (weights p) (subq x (scaleq t v))
  end.
Lemma member_at_real : forall strictly g p v t x, member_at strictly g p v t x = true ->
  exists c, In c (map snd g) /\ inside_at (rc c) (rv v) (Q2R t) (rv x) /\
    (strictly = true -> interior (rc c) (sub (rv x) (scale (Q2R t) (rv v)))).
Proof.
  intros strictly g p v t x H. unfold member_at in H. destruct (find g (piece p)) as [c|] eqn:E; [|discriminate H].
  apply member_inside in H. rewrite rv_sub, rv_scale in H. exists c. split; [apply (find_in _ _ _ E)|exact H].
Qed.

Definition touch_on (v u : vec Q) (A B : group) (h : horizon Q) (n : vec Q) (t : Q) (x : vec Q) (pa pb : place) : bool :=
  in_timeq h t && member_at false A pa v t x && member_at false B pb u t x && lt 0 (dotq n n) &&
  (let l := dotq n (subq x (scaleq t v)) in
   let m := dotq n (subq x (scaleq t u)) in
   forallb (fun a => reach_belowq n l (snd a)) A && forallb (fun b => reach_belowq (oppq n) (- m) (snd b)) B &&
   match slideq n (subq v u) h with None => false | Some s => le s (m - l) end).

Definition contact (v u : vec Q) (A B : group) (h : horizon Q) : Prop :=
  exists t x a b, in_time (rh h) t /\ In a A /\ In b B /\
    inside_at (rc (snd a)) (rv v) t x /\ inside_at (rc (snd b)) (rv u) t x.
Definition bounds_pair (v u : vec Q) (h : horizon Q) (a b : convex R) : Prop :=
  (forall t x, in_time (rh h) t -> inside_at a (rv v) t x -> ~ inside_at b (rv u) t x) \/ slips a b (rv v) (rv u) (rh h).

Lemma touch_on_real : forall v u A B h n t x pa pb, touch_on v u A B h n t x pa pb = true ->
  contact v u A B h /\ forall a b, In a A -> In b B -> bounds_pair v u h (rc (snd a)) (rc (snd b)).
Proof.
  intros v u A B h n t x pa pb H. unfold touch_on in H.
  apply andb_prop in H. destruct H as [H G]. apply andb_prop in H. destruct H as [H N].
  apply andb_prop in H. destruct H as [H MB]. apply andb_prop in H. destruct H as [T MA].
  apply andb_prop in G. destruct G as [G W]. apply andb_prop in G. destruct G as [GA GB]. split.
  - apply member_at_real in MA, MB. destruct MA as (a & IA & XA & _). destruct MB as (b & IB & XB & _).
    apply in_map_iff in IA, IB. destruct IA as (ia & <- & IA). destruct IB as (ib & <- & IB).
    exists (Q2R t), (rv x), ia, ib. split; [apply in_timeq_real, T|]. repeat (split; [assumption|]). assumption.
  - intros a b IA IB. right. rewrite forallb_forall in GA, GB. specialize (GA _ IA). specialize (GB _ IB).
    apply reach_belowq_real in GA, GB. rewrite rv_opp, Q2R_opp in GB.
    destruct (slideq n (subq v u) h) as [s|] eqn:S; [|discriminate W]. apply slideq_real in S. rewrite rv_sub in S.
    apply le_real in W. apply lt_real in N. rewrite Q2R_zero, Q2R_dot in N. rewrite Q2R_minus in W.
    eapply slips_sound; [exact N|exact S|exact GA|exact GB|]. lra.
Qed.

Fixpoint touches (fuel : nat) (p : proof) : bool :=
  match fuel with
  | O => false
  | S fuel =>
      match p with
      | Touch _ _ _ _ _ => true
      | Groups _ _ proofs => existsb (touches fuel) proofs
      | _ => false
      end
  end.
Fixpoint check_on (fuel : nat) (v u : vec Q) (A B : group) (h : horizon Q) (p : proof) : bool :=
  match fuel with
  | O => false
  | S fuel' =>
      if touches fuel p then
        match p with
        | Touch n t x pa pb => touch_on v u A B h n t x pa pb
        | Groups true runs proofs => in_groups (fun g p => check_on fuel' v u g B h p) runs proofs A
        | Groups false runs proofs => in_groups (fun g p => check_on fuel' v u A g h p) runs proofs B
        | _ => false
        end
      else check_out fuel 0 v u A B h p
  end.

Lemma check_on_real : forall fuel v u A B h p, check_on fuel v u A B h p = true ->
  (touches fuel p = true -> contact v u A B h) /\
  forall a b, In a A -> In b B -> bounds_pair v u h (rc (snd a)) (rc (snd b)).
Proof.
  induction fuel as [|fuel IH]; intros v u A B h p H; [discriminate H|].
  cbn [check_on] in H. destruct (touches (S fuel) p) eqn:T.
  - destruct p as [n bounds ma mb|n t x pa pb|t x s pa pb|t prs pa pb|[] runs proofs|cuts proofs|ms ns ps|n s p q|s boxes runs p]; try discriminate H.
    + apply touch_on_real in H. destruct H as [C P]. split; [intros _; exact C|exact P].
    + split.
      * intros _. cbn [touches] in T. apply existsb_exists in T. destruct T as (p & P & T).
        destruct (in_groups_each _ _ _ _ _ p H P) as (s & F & _ & Sub). apply IH in F. destruct F as [F _].
        destruct (F T) as (t & x & a & b & C1 & C2 & C3). exists t, x, a, b. split; [exact C1|]. split; [apply Sub, C2|exact C3].
      * intros a b IA IB. destruct (in_groups_all _ _ _ _ _ a H IA) as (s & p & X & _ & F).
        apply IH in F. apply F; assumption.
    + split.
      * intros _. cbn [touches] in T. apply existsb_exists in T. destruct T as (p & P & T).
        destruct (in_groups_each _ _ _ _ _ p H P) as (s & F & _ & Sub). apply IH in F. destruct F as [F _].
        destruct (F T) as (t & x & a & b & C1 & C2 & C3 & C4). exists t, x, a, b.
        split; [exact C1|]. split; [exact C2|]. split; [apply Sub, C3|exact C4].
      * intros a b IA IB. destruct (in_groups_all _ _ _ _ _ b H IB) as (s & p & X & _ & F).
        apply IH in F. apply F; assumption.
  - split; [discriminate|]. intros a b IA IB. left. intros t x Tt HA HB.
    pose proof (check_out_real _ _ _ _ _ _ _ _ H a b IA IB t x x Tt HA HB) as D.
    rewrite Q2R_zero in D. replace (sub x x) with zero in D by (clear; veq). unfold zero, dot in D. cbn in D. lra.
Qed.

(* in *)
Fixpoint pairs_of (ps qs : list (vec Q)) (prs : list (Z * Z * Q)) : option (list (vec Q * vec Q)) :=
  match prs with
  | [] => Some []
  | (i, j, _) :: prs =>
      match nthq ps i, nthq qs j, pairs_of ps qs prs with
      | Some p, Some q, Some l => Some ((p, q) :: l)
      | _, _, _ => None
      end
  end.
Definition differenceq (p : vec Q * vec Q) := subq (snd p) (fst p).
Lemma pairs_of_in : forall ps qs prs l, pairs_of ps qs prs = Some l ->
  length prs = length l /\ Forall (fun p => In (fst p) ps /\ In (snd p) qs) l.
Proof.
  intros ps qs; induction prs as [|[[i j] w] prs IH]; intros l H; cbn in H.
  - injection H as <-. split; constructor.
  - destruct (nthq ps i) eqn:I; [|discriminate H]. destruct (nthq qs j) eqn:J; [|discriminate H].
    destruct (pairs_of ps qs prs) eqn:E; [|discriminate H]. injection H as <-. destruct (IH _ eq_refl) as [A B].
    split; [cbn; rewrite A; reflexivity|]. constructor; [|exact B]. split; [apply (nthq_in _ _ _ _ I)|apply (nthq_in _ _ _ _ J)].
Qed.

Definition cross_in (v u : vec Q) (A B : group) (h : horizon Q) (t : Q) (prs : list (Z * Z * Q)) (ia ib : Z) : bool :=
  match find A ia, find B ib with
  | Some a, Some b =>
      le 0 (from h) && well_formed_piece a && well_formed_piece b &&
      match pairs_of (corners a) (corners b) prs with
      | None => false
      | Some l =>
          let ws := map snd prs in
          let ds := map differenceq l in
          in_timeq h t && forallb (lt 0) ws && eqv (meanq ws ds) (scaleq (totalq ws * t) (subq v u)) &&
          match ds with
          | [] => false
          | d :: rest =>
              spreadq (map (fun c => subq c d) rest) ||
              (spreadq ds && lt (from h) t && match until h with None => true | Some T => lt t T end)
          end
      end
  | _, _ => false
  end.

Lemma cross_in_real : forall k t prs ia ib,
  cross_in (vA k) (vB k) (numbered 0 (agent k)) (numbered 0 (obstacle k)) (when k) t prs ia ib = true -> in_cone (rk k).
Proof.
  intros k t prs ia ib H. unfold cross_in in H.
  destruct (find _ ia) as [a|] eqn:EA; [|discriminate H]. destruct (find _ ib) as [b|] eqn:EB; [|discriminate H].
  apply andb_prop in H. destruct H as [H G]. apply andb_prop in H. destruct H as [H WB].
  apply andb_prop in H. destruct H as [F0 WA].
  destruct (pairs_of _ _ prs) as [l|] eqn:EP; [|discriminate G]. cbv zeta in G.
  destruct (pairs_of_in _ _ _ _ EP) as [L I].
  apply andb_prop in G. destruct G as [G S]. apply andb_prop in G. destruct G as [G E].
  apply andb_prop in G. destruct G as [T W].
  assert (IA : In (rc a) (agent (rk k))).
  { apply find_in in EA. apply in_map_iff in EA. destruct EA as ([j c] & <- & EA). apply in_map, (numbered_in _ _ _ _ _ EA). }
  assert (IB : In (rc b) (obstacle (rk k))).
  { apply find_in in EB. apply in_map_iff in EB. destruct EB as ([j c] & <- & EB). apply in_map, (numbered_in _ _ _ _ _ EB). }
  set (rp := map (fun p => (rv (fst p), rv (snd p))) l).
  assert (Bel : belong (rc a) (rc b) rp).
  { exists (map rv (corners a)), (map rv (corners b)). split; [intros x; apply corners_inside, WA|].
    split; [intros x; apply corners_inside, WB|]. apply Forall_map. eapply Forall_impl; [|exact I]. cbn.
    intros p [P Q]. split; apply in_map; assumption. }
  assert (Ed : map rv (map differenceq l) = map difference rp).
  { unfold rp. rewrite !map_map. apply map_ext. intros p. unfold differenceq, difference. cbn. apply rv_sub. }
  apply positive_real in W. apply eqv_real in E. rewrite rv_mean, rv_scale, rv_sub, Q2R_mult, Q2R_total, Ed in E.
  set (ws := map Q2R (map snd prs)) in *.
  assert (Lw : length ws = length rp) by (unfold ws, rp; rewrite !map_length; exact L).
  assert (N : ws <> []).
  { intros N. rewrite N in Lw. destruct l; [discriminate S|discriminate Lw]. }
  pose proof (normal_weights _ W N) as W0. set (k0 := (/ total ws)%R).
  assert (K0 : (0 < k0)%R) by (apply Rinv_0_lt_compat; exact W0).
  assert (Wn : Forall (fun w => (0 < w)%R) (map (Rmult k0) ws)).
  { apply Forall_map. eapply Forall_impl; [|exact W]. cbn. intros w Hw. apply Rmult_lt_0_compat; assumption. }
  assert (Tn : total (map (Rmult k0) ws) = 1%R).
  { rewrite total_scaled. unfold k0. field. lra. }
  assert (En : mean (map (Rmult k0) ws) (map difference rp) = scale (Q2R t) (sub (vA (rk k)) (vB (rk k)))).
  { rewrite mean_scaled, E. cbn [vA vB rk].
    transitivity (scale (k0 * total ws * Q2R t) (sub (rv (vA k)) (rv (vB k)))).
    - generalize k0 (total ws) (Q2R t) (rv (vA k)) (rv (vB k)). clear. veq.
    - replace (k0 * total ws)%R with 1%R by (unfold k0; field; lra). rewrite Rmult_1_l. reflexivity. }
  assert (Ln : length (map (Rmult k0) ws) = length rp) by (rewrite map_length; exact Lw).
  apply le_real in F0. rewrite Q2R_zero in F0. apply in_timeq_real in T.
  destruct (map differenceq l) as [|d rest] eqn:ED; [discriminate S|].
  apply orb_prop in S. destruct S as [S|S].
  - destruct rp as [|p rp'] eqn:Erp; [discriminate Ed|]. 
    pose proof (f_equal (hd zero) Ed) as Ed1. pose proof (f_equal (@tl _) Ed) as Ed2. cbn [map hd tl] in Ed1, Ed2.
    apply (cross_overlap (rk k) (rc a) (rc b) p rp' (map (Rmult k0) ws) (Q2R t)); try assumption.
    + destruct T as [T _]. cbn [rh from] in T. lra.
    + apply spreadq_real in S. rewrite <- Ed1, <- Ed2. rewrite map_map in *. erewrite map_ext; [exact S|].
      intros c. cbn. rewrite rv_sub. reflexivity.
  - apply andb_prop in S. destruct S as [S U]. apply andb_prop in S. destruct S as [S F].
    apply spreadq_real in S. rewrite Ed in S. apply lt_real in F.
    apply (cross_passing (rk k) (rc a) (rc b) rp (map (Rmult k0) ws) (Q2R t)); try assumption.
    + cbn. lra.
    + destruct k as [A B v u [t0 [t1|]]]; cbn in *; [apply lt_real, U|trivial].
Qed.

Definition check_in (k : case Q) (p : proof) : bool :=
  let A := numbered 0 (agent k) in
  let B := numbered 0 (obstacle k) in
  match p with
  | Point t x in_agent pa pb =>
      le 0 t && in_timeq (when k) t && member_at in_agent A pa (vA k) t x && member_at (negb in_agent) B pb (vB k) t x
  | Cross t prs ia ib => cross_in (vA k) (vB k) A B (when k) t prs ia ib
  | _ => false
  end.

Lemma in_agent_real : forall k c, In c (map snd (numbered 0 (agent k))) -> In (rc c) (agent (rk k)).
Proof. intros k c H. apply in_map_iff in H. destruct H as ([j d] & <- & H). apply in_map, (numbered_in _ _ _ _ _ H). Qed.
Lemma in_obstacle_real : forall k c, In c (map snd (numbered 0 (obstacle k))) -> In (rc c) (obstacle (rk k)).
Proof. intros k c H. apply in_map_iff in H. destruct H as ([j d] & <- & H). apply in_map, (numbered_in _ _ _ _ _ H). Qed.

Lemma check_in_real : forall k p, check_in k p = true -> in_cone (rk k).
Proof.
  intros k p H. destruct p as [n bounds ma mb|n t x pa pb|t x s pa pb|t prs pa pb|s runs proofs|cuts proofs|ms ns ps|n s p q|s boxes runs p];
    try discriminate H.
  - cbn in H. apply andb_prop in H. destruct H as [H MB]. apply andb_prop in H. destruct H as [H MA].
    apply andb_prop in H. destruct H as [T0 T]. apply le_real in T0. rewrite Q2R_zero in T0.
    apply member_at_real in MA, MB. destruct MA as (a & IA & XA & SA). destruct MB as (b & IB & XB & SB).
    apply (in_sound (rk k) (rc a) (rc b) (Q2R t) (rv x)); auto using in_agent_real, in_obstacle_real.
    + apply in_timeq_real, T.
    + destruct s; [left|right]; auto.
  - apply (cross_in_real _ _ _ _ _ H).
Qed.

(* All of it. *)
Definition filled (b : body Q) : bool := match b with [] => false | _ => forallb well_formed_piece b end.
Definition well_formed_case (k : case Q) : bool :=
  filled (agent k) && filled (obstacle k) && le 0 (from (when k)) &&
  match until (when k) with None => true | Some T => le (from (when k)) T end.
Definition well_formed (c : claim) : bool :=
  match c with Out d k => le 0 d && well_formed_case k | InCone k | OnCone k => well_formed_case k end.

Definition check_claim (fuel : nat) (c : claim) (p : proof) : bool :=
  match c with
  | Out d k => check_out fuel d (vA k) (vB k) (numbered 0 (agent k)) (numbered 0 (obstacle k)) (when k) p
  | InCone k => check_in k p
  | OnCone k => touches fuel p &&
      check_on fuel (vA k) (vB k) (numbered 0 (agent k)) (numbered 0 (obstacle k)) (when k) p
  end.
Definition depth : nat := 100.
Definition check (c : claim) (p : proof) : bool := well_formed c && check_claim depth c p.

Lemma of_numbered : forall (b : body Q) c, In c (map rc b) -> exists x, In x (numbered 0 b) /\ c = rc (snd x).
Proof.
  intros b c H. apply in_map_iff in H. destruct H as (d & <- & H). destruct (in_numbered _ b 0%Z d H) as [j J].
  exists (j, d). split; [exact J|reflexivity].
Qed.

Theorem check_sound : forall c p, check c p = true -> meaning c.
Proof.
  intros c p H. unfold check in H. apply andb_prop in H. destruct H as [_ H].
  generalize dependent depth. intros fuel H. destruct c as [d k|k|k]; cbn [check_claim meaning] in *.
  - apply out_sound. intros a b IA IB. apply of_numbered in IA, IB.
    destruct IA as (x & IA & ->). destruct IB as (y & IB & ->).
    apply (check_out_real _ _ _ _ _ _ _ _ H x y IA IB).
  - apply (check_in_real _ _ H).
  - apply andb_prop in H. destruct H as [T H]. apply check_on_real in H. destruct H as [C P]. split.
    + destruct (C T) as (t & x & [i a] & [j b] & Tt & IA & IB & XA & XB). exists t, x. split; [exact Tt|].
      split; [exists (rc a)|exists (rc b)]; split; try assumption; apply in_map; [apply (numbered_in _ _ _ _ _ IA)|apply (numbered_in _ _ _ _ _ IB)].
    + intros a b IA IB. apply of_numbered in IA, IB.
      destruct IA as (x & IA & ->). destruct IB as (y & IB & ->). exact (P x y IA IB).
Qed.
