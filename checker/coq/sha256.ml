(* SHA-256 (FIPS 180-4) of a text, in hexadecimal. *)

let primes count =
  let rec from n found =
    if List.length found = count then List.rev found
    else if List.exists (fun p -> n mod p = 0) found then from (n + 1) found
    else from (n + 1) (n :: found) in
  from 2 []

(* The first 32 bits of the fraction of the root of n: floor(root(n 2^(32 k))) modulo 2^32. *)
let fraction k n = Z.to_int (Z.logand (Z.root (Z.shift_left (Z.of_int n) (32 * k)) k) (Z.of_int 0xFFFFFFFF))

let word x = x land 0xFFFFFFFF
let rotated x n = word ((x lsr n) lor (x lsl (32 - n)))

let hex text =
  let constants = Array.of_list (List.map (fraction 3) (primes 64)) in
  let state = Array.of_list (List.map (fraction 2) (primes 8)) in
  let size = String.length text in
  let padded = (size + 9 + 63) / 64 * 64 in
  let byte i =
    if i < size then Char.code text.[i]
    else if i = size then 0x80
    else if i < padded - 8 then 0
    else (size * 8) lsr (8 * (padded - 1 - i)) land 0xFF in
  let w = Array.make 64 0 in
  for block = 0 to padded / 64 - 1 do
    for i = 0 to 15 do
      let at = block * 64 + i * 4 in
      w.(i) <- (byte at lsl 24) lor (byte (at + 1) lsl 16) lor (byte (at + 2) lsl 8) lor byte (at + 3)
    done;
    for i = 16 to 63 do
      let a = w.(i - 15) and b = w.(i - 2) in
      let s0 = rotated a 7 lxor rotated a 18 lxor (a lsr 3) and s1 = rotated b 17 lxor rotated b 19 lxor (b lsr 10) in
      w.(i) <- word (w.(i - 16) + s0 + w.(i - 7) + s1)
    done;
    let v = Array.copy state in
    for i = 0 to 63 do
      let e = v.(4) and a = v.(0) in
      let s1 = rotated e 6 lxor rotated e 11 lxor rotated e 25 in
      let choice = (e land v.(5)) lxor (lnot e land v.(6)) in
      let t1 = word (v.(7) + s1 + word choice + constants.(i) + w.(i)) in
      let s0 = rotated a 2 lxor rotated a 13 lxor rotated a 22 in
      let majority = (a land v.(1)) lxor (a land v.(2)) lxor (v.(1) land v.(2)) in
      let t2 = word (s0 + majority) in
      for k = 7 downto 1 do v.(k) <- v.(k - 1) done;
      v.(4) <- word (v.(4) + t1);
      v.(0) <- word (t1 + t2)
    done;
    Array.iteri (fun i x -> state.(i) <- word (x + v.(i))) (Array.copy state)
  done;
  String.concat "" (Array.to_list (Array.map (Printf.sprintf "%08x") state))
