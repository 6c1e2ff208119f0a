(* What is proved, and from which axioms: the tests compare what this prints. *)
From Vericone Require Import Meets Errors.
Check (check_sound : forall (c : claim) (p : proof), check c p = true -> meaning c).
Check (check_contained_sound : forall A B p, check_contained A B p = true -> contained (map rc A) (map rc B)).
Check (check_run_sound : forall c proofs, check_run_claim c proofs = true -> meaning_run c).
Check (check_close_sound : forall d from to A B t x y pa pb,
  check_close d from to A B t x y pa pb = true -> close (Q2R d) (Q2R from) (Q2R to) (rr A) (rr B)).
Check (check_errors_sound : forall d k P W p,
  check_errors d k P W p = true -> out_for_all (Q2R d) (rk k) (rc P) (rc W)).
Check (check_depends_sound : forall k P W c p, check_depends k P W c p = true -> depends (rk k) (rc P) (rc W)).
Print Assumptions check_sound.
Print Assumptions check_contained_sound.
Print Assumptions check_run_sound.
Print Assumptions check_close_sound.
Print Assumptions check_errors_sound.
Print Assumptions check_depends_sound.
