(* vericone-check FILE...: reads certificates, asks the proved checker, prints what was read and the answer.
   Exit status: 0 all are accepted, 1 one is refused, 2 one is no certificate or of a kind unknown here. *)
module C = Checker

(* The statement in words, from what the checker was given. *)

let say_number (x : C.q) = Q.to_string (Reader.fraction x)
let say_list say l = "(" ^ String.concat ", " (List.map say l) ^ ")"
let say_vector (v : C.q C.vec) = say_list say_number C.[v.vx; v.vy; v.vz]
let say_matrix (m : C.q C.mat) = say_list say_vector C.[m.r1; m.r2; m.r3]

let rec say_piece = function
  | C.Ellipsoid (p, f) -> Printf.sprintf "ellipsoid of factor %s about %s" (say_matrix f) (say_vector p)
  | C.Shaped (p, s) -> Printf.sprintf "ellipsoid of shape %s about %s" (say_matrix s) (say_vector p)
  | C.Ball (p, r) -> Printf.sprintf "ball of radius %s about %s" (say_number r) (say_vector p)
  | C.Box (lo, hi) -> Printf.sprintf "box from %s to %s" (say_vector lo) (say_vector hi)
  | C.Hull ps -> Printf.sprintf "hull of %s" (say_list say_vector ps)
  | C.Cut (c, p, a, l) ->
    Printf.sprintf "%s, of it what is of matrix %s about %s at most %s" (say_piece c) (say_matrix a) (say_vector p) (say_number l)

(* In full, or the digest of the words where they are many. *)
let say_body pieces =
  let words = String.concat "; " (List.map say_piece pieces) in
  if String.length words <= 2000 then words
  else Printf.sprintf "%d pieces, SHA-256 of their words %s" (List.length pieces) (Sha256.hex words)

let say_case (k : C.q C.case) moving =
  let body pieces v = say_body pieces ^ if moving then ", velocity " ^ say_vector v else "" in
  let times = match k.C.when0.C.until with
    | None -> "from " ^ say_number k.C.when0.C.from ^ " on"
    | Some t -> "from " ^ say_number k.C.when0.C.from ^ " to " ^ say_number t in
  Printf.sprintf "agent {%s}; obstacle {%s}%s" (body k.C.agent k.C.vA) (body k.C.obstacle k.C.vB)
    (if moving then "; times " ^ times else "")

let say_verdict says claim =
  let moving = List.mem says ["out"; "in"; "on"] in
  let what, k = match claim with
    | C.Out (d, k) -> ((if Z.sign d.C.qnum = 0 then "no common point" else "farther apart than " ^ say_number d), k)
    | C.InCone k -> ("they meet, and not merely touch", k)
    | C.OnCone k -> ("they touch, and no pieces overlap", k) in
  Printf.sprintf "%s: %s. %s" says what (say_case k moving)

let shortened words = if String.length words <= 2000 then words
  else Printf.sprintf "(%d letters, SHA-256 %s)" (String.length words) (Sha256.hex words)

let say_segment (g : C.q C.segment) =
  let quaternion q = say_list say_number C.[q.qw; q.qx; q.qy; q.qz] in
  Printf.sprintf "from %s to %s: positions %s, turns %s" (say_number g.C.starts) (say_number g.C.ends)
    (say_list say_vector g.C.positions) (say_list quaternion g.C.turns)
let say_runner (r : C.q C.runner) =
  Printf.sprintf "{%s; track %s; radius %s}" (say_body r.C.its_body)
    (shortened (String.concat "; " (List.map say_segment r.C.track))) (say_number r.C.radius)

let say_run (c : C.run_claim) =
  Printf.sprintf "apart: from %s to %s farther apart than %s, the pairs %s of %s" (say_number c.C.start)
    (say_number c.C.finish) (say_number c.C.by_more_than)
    (say_list (fun (i, j) -> Printf.sprintf "(%s, %s)" (Z.to_string i) (Z.to_string j)) c.C.pairs)
    (String.concat ", " (List.map say_runner c.C.runners))

let told accepted words =
  if accepted then ("accepted: " ^ words, 0) else ("refused, the proof does not hold: " ^ words, 1)

let answer line =
  match
    match Reader.statement (Json.parse line) with
    | Reader.Verdict (says, claim, proof) -> let proof = proof () in told (C.check claim proof) (say_verdict says claim)
    | Reader.Depends (k, positions, velocities, proofs) ->
      let collides, passes = proofs () in
      told (C.check_depends k positions velocities collides passes)
        (Printf.sprintf "depends: with some errors they meet, with some they do not. %s; errors of the obstacle's position in {%s}, of the agent's velocity in {%s}"
           (say_case k true) (say_piece positions) (say_piece velocities))
    | Reader.Robust (d, k, positions, velocities, proof) ->
      let proof = proof () in
      told (C.check_errors d k positions velocities proof)
        (Printf.sprintf "%s; for all errors of the obstacle's position in {%s}, of the agent's velocity in {%s}"
           (say_verdict "out" (C.Out (d, k))) (say_piece positions) (say_piece velocities))
    | Reader.Fit (agent, obstacle, proof) ->
      let proof = proof () in
      told (C.check_contained agent obstacle proof)
        (Printf.sprintf "inside: each point of the agent {%s} is in the obstacle {%s}" (say_body agent) (say_body obstacle))
    | Reader.Meeting m ->
      told Reader.(C.check_close m.no_farther m.start m.finish m.one m.other m.time m.point_one m.point_other m.where_one m.where_other)
        Reader.(Printf.sprintf "%s: at a time from %s to %s a point of %s and one of %s are no farther apart than %s, wherever in the tubes"
                  m.says (say_number m.start) (say_number m.finish) (say_runner m.one) (say_runner m.other) (say_number m.no_farther))
    | Reader.Run (claim, proofs) -> let proofs = proofs () in told (C.check_run_claim claim proofs) (say_run claim)
  with
  | answer -> answer
  | exception Reader.Refused words -> ("refused, this does not hold: " ^ words, 1)
  | exception Json.Malformed words -> ("no certificate: " ^ words, 2)
  | exception Reader.Unknown words -> ("not known to this checker: " ^ words, 2)
  | exception (Stack_overflow | Out_of_memory) -> ("no certificate: too large", 2)
  | exception Sys_error words -> ("no certificate: " ^ words, 2)

(* What reading a text takes at most, in bytes: a little more than was measured. *)
let cost text =
  let count found c = match c with '{' -> found + 200 | ',' -> found + 120 | '[' -> found + 100 | _ -> found in
  String.fold_left count (16 * String.length text) text

let told_of memory text =
  if cost text > memory then (Printf.sprintf "no certificate: %d bytes of memory needed, %d allowed (--memory)" (cost text) memory, 2)
  else answer text

(* A line, cut off after `most` bytes; None at the end. *)
let next_line channel most =
  let buffer = Buffer.create 80 in
  let rec more () = match input_char channel with
    | '\n' -> Some (Buffer.contents buffer)
    | c -> if Buffer.length buffer <= most then Buffer.add_char buffer c; more ()
    | exception End_of_file -> if Buffer.length buffer = 0 then None else Some (Buffer.contents buffer) in
  more ()

let is_whole memory text =
  cost text <= memory && (match Json.value text 0 with _, i -> i = String.length text | exception _ -> false)

(* Each certificate of a file: the one of all its lines, or one a line. *)
let each channel memory judge =
  let most = memory / 16 in
  let rec lines = function
    | Some line -> if String.trim line <> "" then judge line; lines (next_line channel most)
    | None -> () in
  let rest first =
    let buffer = Buffer.create (String.length first) in
    Buffer.add_string buffer first;
    let rec more () = if Buffer.length buffer <= most then match next_line channel most with
        | Some line -> Buffer.add_char buffer '\n'; Buffer.add_string buffer line; more ()
        | None -> () in
    more ();
    Buffer.contents buffer in
  match next_line channel most with
  | None -> ()
  | Some first when String.trim first = "" || is_whole memory first || cost first > memory -> lines (Some first)
  | Some first -> (* a value of several lines; if it is none, each line is judged *)
    let all = rest first in
    if is_whole memory all || cost all > memory then judge all
    else List.iter (fun line -> if String.trim line <> "" then judge line) (String.split_on_char '\n' all)

let check_file memory name =
  let statuses = ref [] and seen = ref 0 in
  let judge text =
    incr seen;
    let words, status = told_of memory text in
    Printf.printf "%s: %d: %s\n" name !seen words;
    statuses := status :: !statuses in
  let complain words =
    Printf.printf "%s: no certificate: %s\n" name words;
    statuses := 2 :: !statuses in
  (match
     if name = "-" then each stdin memory judge
     else begin
       let channel = open_in_bin name in
       Fun.protect ~finally:(fun () -> close_in channel) (fun () -> each channel memory judge)
     end
   with
   | () -> if !seen = 0 then complain "empty"
   | exception Sys_error words -> complain words);
  !statuses

let usage = "vericone-check [--memory MB] FILE...: checks certificates (- is the standard input).\n\
             Exit status: 0 all are accepted, 1 one is refused, 2 one is no certificate or unknown to this checker."

let () =
  let rec options memory files = function
    | "--memory" :: megabytes :: rest ->
      (match int_of_string_opt megabytes with
       | Some m when m > 0 && m < 1_000_000 -> options (m * 1_000_000) files rest
       | _ -> prerr_endline usage; exit 2)
    | ("--help" | "-h") :: _ -> print_endline usage; exit 0
    | name :: rest -> options memory (name :: files) rest
    | [] -> (memory, List.rev files) in
  let memory, files = options 180_000_000 [] (List.tl (Array.to_list Sys.argv)) in
  if files = [] then begin prerr_endline usage; exit 2 end;
  let statuses = List.concat_map (check_file memory) files in
  exit (if List.mem 1 statuses then 1 else List.fold_left max 0 statuses)
