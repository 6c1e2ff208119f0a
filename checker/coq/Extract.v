(* The checker as a program of OCaml; integers are those of Zarith, as Coq's own ExtrOcamlZBigInt has it, and so is the
   greatest common divisor, which Coq would take bit by bit. *)
From Vericone Require Import Meets Errors.
Require Import Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
Extraction Language OCaml.
Extract Constant Z.ggcd => "(fun a b -> let g = Big_int_Z.gcd_big_int a b in
  if Big_int_Z.sign_big_int g = 0 then (g, (a, b))
  else (g, (Big_int_Z.div_big_int a g, Big_int_Z.div_big_int b g)))".
Extraction "checker.ml" check well_formed depth filled check_run_claim check_contained check_close means_at check_errors check_depends
  well_formed_piece.
