(* Polynomials on [0, 1] as forms of s and t with s + t = 1: sums, products, parts, signs. *)
From Vericone Require Export Check Motion.
Open Scope Q_scope.

Definition form_q := list Q.
Definition value (p : form_q) (s t : R) : R := sum_form (map Q2R p) s t.

Fixpoint raise_from (a : Q) (p : form_q) : form_q := match p with [] => [a] | c :: p => reduced (c + a) :: raise_from c p end.
Definition raise (p : form_q) : form_q := raise_from 0 p. (* times s + t *)
Fixpoint raised (k : nat) (p : form_q) : form_q := match k with O => p | S k => raised k (raise p) end.
Fixpoint sum_same (p q : form_q) : form_q :=
  match p, q with a :: p, b :: q => reduced (a + b) :: sum_same p q | [], q => q | p, [] => p end.
Definition sum (p q : form_q) : form_q :=
  sum_same (raised (length q - length p) p) (raised (length p - length q) q).
Definition times (c : Q) (p : form_q) : form_q := map (fun x => reduced (c * x)) p.
Fixpoint product (p q : form_q) : form_q :=
  match p with [] => [] | c :: p => sum (times c q ++ repeat 0 (length p)) (0 :: product p q) end.
Fixpoint power (p : form_q) (n : nat) : form_q := match n with O => [1] | S n => product p (power p n) end.
(* The form at s = the form a, t = the form b. *)
Fixpoint part (p a b : form_q) : form_q :=
  match p with
  | [] => []
  | [c] => [c] (* of degree 0: nothing is raised *)
  | c :: p => sum (times c (power a (length p))) (product b (part p a b))
  end.

Section Values.
Variables s t : R.
Hypothesis one : (s + t = 1)%R.

Lemma raise_from_length : forall p a, length (raise_from a p) = S (length p).
Proof. induction p as [|c p IH]; intros a; cbn; [reflexivity|]. rewrite IH. reflexivity. Qed.
Lemma raise_from_value : forall p a, value (raise_from a p) s t = (value p s t + Q2R a * s ^ length p)%R.
Proof.
  induction p as [|c p IH]; intros a; unfold value in *; cbn; [ring|].
  rewrite IH, !map_length, raise_from_length, reduced_value, Q2R_plus. cbn.
  transitivity (Q2R c * s ^ length p * (s + t) + t * sum_form (map Q2R p) s t + Q2R a * (s * s ^ length p))%R; [ring|].
  rewrite one. ring.
Qed.
Lemma raise_value : forall p, value (raise p) s t = value p s t.
Proof. intros p. unfold raise. rewrite raise_from_value, Q2R_zero. ring. Qed.
Lemma raised_value : forall k p, value (raised k p) s t = value p s t.
Proof. induction k as [|k IH]; intros p; [reflexivity|]. cbn [raised]. rewrite IH. apply raise_value. Qed.
Lemma raised_length : forall k p, length (raised k p) = (k + length p)%nat.
Proof.
  induction k as [|k IH]; intros p; [reflexivity|]. cbn. rewrite IH. unfold raise. rewrite raise_from_length. lia.
Qed.
Lemma sum_same_length : forall p q, length p = length q -> length (sum_same p q) = length p.
Proof. induction p as [|a p IH]; intros [|b q] L; try discriminate L; [reflexivity|]. cbn. rewrite IH; [reflexivity|]. injection L; auto. Qed.
Lemma sum_same_value : forall p q, length p = length q -> value (sum_same p q) s t = (value p s t + value q s t)%R.
Proof.
  induction p as [|a p IH]; intros [|b q] L; try discriminate L; unfold value in *; cbn; [ring|].
  injection L as L. rewrite IH by assumption. rewrite !map_length, sum_same_length, L, reduced_value, Q2R_plus by assumption. ring.
Qed.
Lemma sum_value : forall p q, value (sum p q) s t = (value p s t + value q s t)%R.
Proof.
  intros p q. unfold sum. rewrite sum_same_value, !raised_value; [reflexivity|]. rewrite !raised_length. lia.
Qed.
Lemma times_value : forall c p, value (times c p) s t = (Q2R c * value p s t)%R.
Proof.
  intros c; induction p as [|a p IH]; unfold value, times in *; cbn; [ring|].
  rewrite IH, !map_length, reduced_value, Q2R_mult. ring.
Qed.
Lemma zeros_value : forall k, value (repeat 0 k) s t = 0%R.
Proof. induction k as [|k IH]; [reflexivity|]. unfold value in *. cbn. rewrite IH, Q2R_zero. ring. Qed.
Lemma padded_value : forall p k, value (p ++ repeat 0 k) s t = (s ^ k * value p s t)%R.
Proof.
  induction p as [|a p IH]; intros k.
  - cbn [app]. rewrite zeros_value. unfold value. cbn. ring.
  - unfold value in *. cbn. rewrite IH, !map_length, app_length, repeat_length, pow_add. ring.
Qed.
Lemma product_value : forall p q, value (product p q) s t = (value p s t * value q s t)%R.
Proof.
  induction p as [|c p IH]; intros q; [unfold value; cbn; ring|]. cbn [product].
  rewrite sum_value, padded_value, times_value.
  assert (E : value (0 :: product p q) s t = (t * value (product p q) s t)%R).
  { unfold value. cbn. rewrite Q2R_zero. ring. }
  rewrite E, IH. unfold value. cbn. rewrite map_length. ring.
Qed.
Lemma power_value : forall p n, value (power p n) s t = (value p s t ^ n)%R.
Proof.
  intros p n; induction n as [|n IH]; cbn [power pow].
  - unfold value. cbn. rewrite Q2R_one. ring.
  - rewrite product_value, IH. reflexivity.
Qed.
Lemma part_value : forall a b p, value (part p a b) s t = value p (value a s t) (value b s t).
Proof.
  intros a b; induction p as [|c p IH]; [reflexivity|]. destruct p as [|d p]; [unfold value; cbn; ring|].
  change (part (c :: d :: p) a b) with (sum (times c (power a (length (d :: p)))) (product b (part (d :: p) a b))).
  rewrite sum_value, times_value, power_value, product_value, IH. unfold value. cbn. rewrite map_length. ring.
Qed.

(* Signs. *)
Definition not_negative (p : form_q) : bool := forallb (le 0) p.
Definition positive (p : form_q) : bool := not_negative p && lt 0 (hd 0 p) && lt 0 (last p 0).

Hypothesis s0 : (0 <= s)%R.
Hypothesis t0 : (0 <= t)%R.
Lemma not_negative_value : forall p, not_negative p = true -> (0 <= value p s t)%R.
Proof.
  induction p as [|c p IH]; intros H; unfold value in *; cbn in *; [lra|].
  apply andb_prop in H. destruct H as [C H]. apply le_real in C. rewrite Q2R_zero in C. specialize (IH H).
  assert (0 <= s ^ length (map Q2R p))%R by (apply pow_le; assumption).
  apply Rplus_le_le_0_compat; apply Rmult_le_pos; assumption.
Qed.
Lemma last_value : forall p, value p 0 1 = Q2R (last p 0).
Proof.
  induction p as [|c p IH]; [symmetry; apply Q2R_zero|]. destruct p as [|d p].
  - unfold value. cbn. ring.
  - change (last (c :: d :: p) 0) with (last (d :: p) 0). rewrite <- IH. unfold value. cbn. ring.
Qed.
Lemma positive_value : forall p, positive p = true -> (0 < value p s t)%R.
Proof.
  intros p H. unfold positive in H. apply andb_prop in H. destruct H as [H L]. apply andb_prop in H. destruct H as [N F].
  apply lt_real in L, F. rewrite Q2R_zero in L, F.
  destruct (Req_dec s 0) as [Z|Z].
  - rewrite Z. replace t with 1%R by lra. rewrite last_value. exact L.
  - destruct p as [|c p]; [cbn in F; lra|]. cbn [hd] in F. cbn in N. apply andb_prop in N. destruct N as [_ N].
    pose proof (not_negative_value p N). unfold value in *. cbn.
    assert (0 < s ^ length (map Q2R p))%R by (apply pow_lt; lra).
    assert (0 < Q2R c * s ^ length (map Q2R p))%R by (apply Rmult_lt_0_compat; assumption).
    assert (0 <= t * sum_form (map Q2R p) s t)%R by (apply Rmult_le_pos; assumption). lra.
Qed.
End Values.

(* Bernstein coefficients. *)
Definition of_bernstein (bs : list Q) : form_q :=
  map (fun p => reduced (inject_Z (fst p) * snd p)) (combine (binomials (pred (length bs))) bs).
Lemma of_bernstein_value : forall bs u, value (of_bernstein bs) (1 - u) u = bernstein (map Q2R bs) u.
Proof.
  intros bs u. unfold value, of_bernstein, bernstein. f_equal. rewrite !map_length.
  generalize (binomials (pred (length bs))). intros zs. revert bs.
  induction zs as [|z zs IH]; intros [|b bs]; try reflexivity. cbn. rewrite IH, reduced_value, Q2R_mult. f_equal.
  f_equal. unfold Q2R, inject_Z. cbn. field.
Qed.
