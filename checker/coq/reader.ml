(* The format of certificates (docs/reference/certificates.md, version 1) read into what the checker takes.
   This part is not proved: it is strict, and main.ml prints the statement from what was read here. *)
open Json
module C = Checker

(* What the format has and this checker does not know. *)
exception Unknown of string
let unknown words = raise (Unknown words)

(* Numbers. *)

let longest = 4300

let rational (x : Q.t) : C.q = { C.qnum = Q.num x; C.qden = Q.den x }
let fraction (x : C.q) : Q.t = Q.make x.C.qnum x.C.qden

(* The double nearest to a decimal, exactly. *)
let double text =
  let x = float_of_string text in
  form (Float.is_finite x) (text ^ " is no finite double");
  let mantissa, exponent = Float.frexp x in
  let whole = Z.of_float (Float.ldexp mantissa 53) and shift = exponent - 53 in
  if shift >= 0 then Q.of_bigint (Z.shift_left whole shift) else Q.make whole (Z.shift_left Z.one (-shift))

let is_digits text = text <> "" && String.for_all (fun c -> c >= '0' && c <= '9') text

let written text =
  let unsigned = if text <> "" && text.[0] = '-' then String.sub text 1 (String.length text - 1) else text in
  let top, bottom = match String.index_opt unsigned '/' with
    | None -> (unsigned, "1")
    | Some i -> (String.sub unsigned 0 i, String.sub unsigned (i + 1) (String.length unsigned - i - 1)) in
  form (is_digits top && is_digits bottom) "a text that is no fraction";
  let bottom = Z.of_string bottom in
  form (Z.sign bottom > 0) "a denominator of 0";
  let top = Z.of_string top in
  Q.make (if unsigned == text then top else Z.neg top) bottom

let number = function
  | Number text -> form (String.length text <= longest) "a number that is too long"; double text
  | Text text -> form (String.length text <= longest) "a number that is too long"; written text
  | _ -> malformed "a number is missing"
let not_negative value = let x = number value in form (Q.sign x >= 0) "a number below 0"; x

let index limit = function
  | Number text when is_digits text && String.length text < 16 ->
    let k = int_of_string text in
    form (k < limit) (Printf.sprintf "%d is no index below %d" k limit);
    k
  | _ -> malformed "an index is missing"

let items ?(least = 1) = function
  | List l -> form (List.compare_length_with l least >= 0) (Printf.sprintf "a list of %d or more is missing" least); l
  | _ -> malformed "a list is missing"

let vector value = match items value with
  | [x; y; z] -> { C.vx = number x; vy = number y; vz = number z }
  | _ -> malformed "a vector is a list of three numbers"
let map_vector f (v : 'a C.vec) = { C.vx = f v.C.vx; vy = f v.C.vy; vz = f v.C.vz }
let rational_vector v = map_vector rational v
let vector_of value = rational_vector (vector value)
let plus (a : Q.t C.vec) (b : Q.t C.vec) =
  C.{ vx = Q.add a.vx b.vx; vy = Q.add a.vy b.vy; vz = Q.add a.vz b.vz }
let origin = { C.vx = Q.zero; vy = Q.zero; vz = Q.zero }

let matrix value = match items value with
  | [a; b; c] -> C.{ r1 = vector a; r2 = vector b; r3 = vector c }
  | _ -> malformed "a matrix is a list of three rows"
let rational_matrix (m : Q.t C.mat) = C.{ r1 = rational_vector m.r1; r2 = rational_vector m.r2; r3 = rational_vector m.r3 }

(* Fields. *)

let fields what needed allowed = function
  | Object members ->
    List.iter (fun name -> form (List.mem_assoc name members) (what ^ " must have " ^ name)) needed;
    List.iter (fun (name, _) -> form (List.mem name needed || List.mem name allowed) (what ^ ": unknown field " ^ name)) members;
    members
  | _ -> malformed (what ^ " is missing")
let field name members = List.assoc name members
let optional name members = List.assoc_opt name members
let text name members = match field name members with Text t -> t | _ -> malformed (name ^ " must be a text")
let kind_of what = function
  | Object members -> (match List.assoc_opt "kind" members with Some (Text t) -> t | _ -> malformed (what ^ " has no kind"))
  | _ -> malformed (what ^ " is missing")

(* Bodies: their pieces, in the order in which they stand. *)

let body_fields = [
  ("ellipsoid", ([], ["factor"; "shape"])); ("ball", (["center"; "radius"], [])); ("hull", (["points"], []));
  ("box", (["low"; "high"], [])); ("delimited", (["delimiters"], ["factor"; "shape"])); ("mesh", (["points"; "triangles"], [])); ("cloud", (["points"; "radius"], []));
  ("boxes", (["boxes"], [])); ("union", (["pieces"], [])); ("octree", (["low"; "cell"; "depth"; "tree"], [])) ]

let coordinates value = (* of meshes, clouds and boxes *)
  List.iter (function Number _ -> () | _ -> malformed "coordinates are JSON numbers here") (items value);
  vector value

(* The boxes of an octree: a node is eight characters, of its cell's eighths; the nodes of its `+` follow it. *)
let cells low cell depth tree =
  let next = ref 0 and found = ref [] in
  let corner (at : Q.t C.vec) edge bits =
    let along bit x = if bits land bit <> 0 then Q.add x edge else x in
    { C.vx = along 1 at.C.vx; vy = along 2 at.C.vy; vz = along 4 at.C.vz } in
  let rec node low edge below = (* `below`: how many times its cells may be divided *)
    form (below >= 0 && !next + 8 <= String.length tree) "each + has a node, and none has cells below the smallest";
    let first = !next in
    next := first + 8;
    for bits = 0 to 7 do
      let at = corner low edge bits in
      match tree.[first + bits] with
      | '+' -> node at (Q.div_2exp edge 1) (below - 1)
      | '#' -> found := (at, corner at edge 7) :: !found
      | '.' -> ()
      | _ -> malformed "nodes are eight of .#+ each"
    done in
  node low (Q.mul_2exp cell depth) depth;
  form (!found <> [] && !next = String.length tree) "an octree has cells, and no node too many";
  List.rev !found

let rec body ~moves ~inner value : (C.q C.body * (string * t) list) =
  let kind = kind_of "a body" value in
  let needed, allowed = match List.assoc_opt kind body_fields with
    | Some known -> known
    | None when List.mem kind ["quadrics"; "convex"; "wall"] -> unknown ("the kind " ^ kind)
    | None -> malformed ("an unknown kind of body: " ^ kind) in
  let read = fields ("the " ^ kind) (("kind" :: needed) @ (if moves then ["velocity"] else [])) ("center" :: allowed) value in
  let p = match optional "center" read with Some c -> vector c | None -> origin in
  let at x = rational_vector (plus p x) in
  let pieces = match kind with
    | "ellipsoid" -> [ellipsoid p read]
    | "delimited" ->
      let cut c value =
        let read = fields "a delimiter" ["matrix"; "level"] [] value in
        C.Cut (c, rational_vector p, rational_matrix (matrix (field "matrix" read)), rational (number (field "level" read))) in
      [List.fold_left cut (ellipsoid p read) (items (field "delimiters" read))]
    | "ball" -> [C.Ball (rational_vector p, rational (not_negative (field "radius" read)))]
    | "hull" -> [C.Hull (List.map (fun x -> at (vector x)) (items (field "points" read)))]
    | "box" -> [C.Box (at (vector (field "low" read)), at (vector (field "high" read)))]
    | "mesh" ->
      let points = Array.of_list (List.map (fun x -> at (coordinates x)) (items (field "points" read))) in
      let corner k = points.(index (Array.length points) k) in
      List.map (fun three -> match items three with
          | [i; j; k] -> C.Hull [corner i; corner j; corner k]
          | _ -> malformed "a triangle has three indices") (items (field "triangles" read))
    | "cloud" ->
      let r = rational (not_negative (field "radius" read)) in
      List.map (fun x -> C.Ball (at (coordinates x), r)) (items (field "points" read))
    | "boxes" ->
      List.map (fun ends -> match items ends with
          | [low; high] -> C.Box (at (coordinates low), at (coordinates high))
          | _ -> malformed "a box has two ends") (items (field "boxes" read))
    | "union" ->
      form (not inner) "a union in a union";
      let part value =
        let kind = kind_of "a piece" value in
        if List.mem kind ["quadrics"; "convex"] then unknown ("the kind " ^ kind);
        form (List.mem (kind_of "a piece" value) ["ellipsoid"; "ball"; "hull"; "box"; "delimited"]) "a piece of a union of another kind";
        List.map (moved p) (fst (body ~moves:false ~inner:true value)) in
      List.concat_map part (items (field "pieces" read))
    | _ ->
      let cell = number (field "cell" read) in
      form (Q.sign cell > 0) "cells have an edge above 0";
      List.map (fun (low, high) -> C.Box (at low, at high))
        (cells (vector (field "low" read)) cell (index 64 (field "depth" read)) (text "tree" read)) in
  (pieces, read)

and ellipsoid p read = match optional "factor" read, optional "shape" read with
  | Some f, None -> C.Ellipsoid (rational_vector p, rational_matrix (matrix f))
  | None, Some s -> C.Shaped (rational_vector p, rational_matrix (matrix s))
  | _ -> malformed "an ellipsoid has either factor or shape"

and moved (p : Q.t C.vec) (c : C.q C.convex) =
  let at v = rational_vector (plus p (map_vector fraction v)) in
  match c with
  | C.Ellipsoid (c, f) -> C.Ellipsoid (at c, f)
  | C.Shaped (c, s) -> C.Shaped (at c, s)
  | C.Ball (c, r) -> C.Ball (at c, r)
  | C.Box (a, b) -> C.Box (at a, at b)
  | C.Hull ps -> C.Hull (List.map at ps)
  | C.Cut (c, center, a, l) -> C.Cut (moved p c, at center, a, l)

(* Proofs. *)

type sides = { agent_pieces : int; obstacle_pieces : int; by : bool; moving_w : Q.t C.vec }

let places value =
  let corners = List.map (fun pair -> match items pair with
      | [k; w] -> (index max_int k, rational (number w))
      | [_; _; _] -> unknown "weights of round parts"
      | _ -> malformed "weights are pairs of a corner and a number") (items value) in
  let seen = List.sort_uniq compare (List.map fst corners) in
  form (List.length seen = List.length corners) "a corner twice";
  List.map (fun (k, w) -> (Z.of_int k, w)) corners

let piece_of count name read = match optional name read with
  | Some k -> Z.of_int (index count k)
  | None -> form (count = 1) (name ^ " is missing"); Z.zero

let where sides read =
  let place count who =
    { C.piece = piece_of count (who ^ "_piece") read;
      weights = (match optional (who ^ "_weights") read with Some w -> places w | None -> []) } in
  (place sides.agent_pieces "agent", place sides.obstacle_pieces "obstacle")
let members = ["agent_piece"; "obstacle_piece"; "agent_weights"; "obstacle_weights"]

let across sides value = match items value with
  | [k; a; b] ->
    let k = index 3 k and a = rational (number a) and b = rational (number b) in
    let w = sides.moving_w in
    let w_k = match k with 0 -> w.C.vx | 1 -> w.C.vy | _ -> w.C.vz in
    (* n would be right all the same; the format wants it so *)
    if Q.sign w_k = 0 then None
    else Some (match k with 0 -> C.AcrossX (a, b) | 1 -> C.AcrossY (a, b) | _ -> C.AcrossZ (a, b))
  | _ -> malformed "across_w is a list of three"

exception Refused of string

let numbers value = List.map (fun x -> rational (number x)) (items value)

let factor = function
  | Text "one" -> C.One
  | Text "from" -> C.SinceFrom
  | Text "until" -> C.BeforeUntil
  | List [Text "agent"; a] -> C.OfAgent (vector_of a)
  | List [Text "obstacle"; a] -> C.OfObstacle (vector_of a)
  | List [Text "cut"; k] -> C.OfCut (Z.of_int (index max_int k))
  | _ -> malformed "an unknown factor"
let product value = match items value with
  | [a; b; m] -> ((factor a, factor b), rational (not_negative m))
  | _ -> malformed "products are lists of three"

let normal sides read = match optional "n" read, optional "across_w" read with
  | Some n, None -> C.Given (vector_of n)
  | None, Some k -> (match across sides k with Some n -> n | None -> raise (Refused "w_k != 0"))
  | _ -> malformed "a plane has either n or across_w"
let multipliers who read = Option.map numbers (optional (who ^ "_multipliers") read)

let of_agent read = match text "of" read with
  | "agent" -> true | "obstacle" -> false | _ -> malformed "`of` is the agent or the obstacle"

(* Boxes that hold pieces. *)
let held value =
  let box ends = match items ends with
    | [low; high] -> (vector_of low, vector_of high)
    | _ -> malformed "a box has two ends" in
  List.map box (items value)

let rec proof sides value : C.proof =
  let rule = match value with
    | Object m -> (match List.assoc_opt "rule" m with Some (Text t) -> t | _ -> malformed "a proof must have a rule")
    | _ -> malformed "a proof must have a rule" in
  let read needed allowed = fields ("the rule " ^ rule) ("rule" :: needed) allowed value in
  match rule with
  | "plane" ->
    let read = read [] ["n"; "across_w"; "agent_at_most"; "obstacle_at_least"; "agent_multipliers"; "obstacle_multipliers"] in
    let multipliers who = multipliers who read and n = normal sides read in
    (match optional "agent_at_most" read, optional "obstacle_at_least" read with
     | Some l, Some m -> C.Plane (n, Some (rational (number l), rational (number m)), multipliers "agent", multipliers "obstacle")
     | None, None ->
       form (not sides.by && multipliers "agent" = None && multipliers "obstacle" = None)
         "a plane with `by` or multipliers has agent_at_most and obstacle_at_least";
       C.Plane (n, None, None, None)
     | _ -> malformed "agent_at_most and obstacle_at_least stand together")
  | "touch" ->
    let read = read ["n"; "time"; "point"] members in
    let a, b = where sides read in
    C.Touch (vector_of (field "n" read), rational (number (field "time" read)), vector_of (field "point" read), a, b)
  | "point" ->
    let read = read ["time"; "point"; "inside"] members in
    let a, b = where sides read in
    let in_agent = match text "inside" read with
      | "agent" -> true | "obstacle" -> false | "both" -> unknown "a point inside of both"
      | _ -> malformed "inside must be agent, obstacle or both" in
    C.Point (rational (number (field "time" read)), vector_of (field "point" read), in_agent, a, b)
  | "cross" ->
    let read = read ["time"; "pairs"] ["agent_piece"; "obstacle_piece"] in
    let pair value = match items value with
      | [i; j; s] -> ((Z.of_int (index max_int i), Z.of_int (index max_int j)), rational (number s))
      | _ -> malformed "pairs are lists of three" in
    C.Cross (rational (number (field "time" read)), List.map pair (items (field "pairs" read)),
             piece_of sides.agent_pieces "agent_piece" read, piece_of sides.obstacle_pieces "obstacle_piece" read)
  | "groups" ->
    let read = read ["of"; "runs"; "proofs"] [] in
    C.Groups (of_agent read, runs (field "runs" read), List.map (proof sides) (items (field "proofs" read)))
  | "times" ->
    let read = read ["cuts"; "proofs"] [] in
    let cuts = items (field "cuts" read) and proofs = items (field "proofs" read) in
    form (List.length proofs = List.length cuts + 1) "times have one proof more than cuts";
    C.Times (List.map (fun c -> rational (number c)) cuts, List.map (proof sides) proofs)
  | "forms" ->
    let read = read ["agent"; "obstacle"] ["products"] in
    let some name = List.map (fun x -> rational (number x)) (items ~least:0 (field name read)) in
    let products = match optional "products" read with Some l -> List.map product (items ~least:0 l) | None -> [] in
    C.Forms (some "agent", some "obstacle", products)
  | "halves" ->
    let read = read ["normal"; "at"; "below"; "above"] [] in
    let half name = proof sides (field name read) in
    C.Halves (vector_of (field "normal" read), rational (number (field "at" read)), half "below", half "above")
  | "cover" ->
    let read = read ["of"; "boxes"; "runs"; "proof"] [] in
    C.Cover (of_agent read, held (field "boxes" read), runs (field "runs" read), proof sides (field "proof" read))
  | "octants" | "errors" | "vertices" -> unknown ("the rule " ^ rule)
  | _ -> malformed ("an unknown rule: " ^ rule)

and runs value =
  let run value = match items value with
    | [k; count] -> (Z.of_int (index max_int k), Z.of_int (index max_int count))
    | _ -> malformed "a run is a pair" in
  List.map run (items value)

(* Claims. *)

type one_error = (C.q C.vec * C.q C.vec) * C.proof
type statement =
  | Verdict of string * C.claim * (unit -> C.proof)
  | Depends of C.q C.case * C.q C.convex * C.q C.convex * (unit -> one_error * one_error)
  | Robust of C.q * C.q C.case * C.q C.convex * C.q C.convex * (unit -> C.error_proof)
  | Fit of C.q C.body * C.q C.body * (unit -> C.fit_proof)
  | Run of C.run_claim * (unit -> C.run_proof list)
  | Meeting of meeting
and meeting = {
  says : string; no_farther : C.q; start : C.q; finish : C.q; one : C.q C.runner; other : C.q C.runner;
  time : C.q; point_one : C.q C.vec; point_other : C.q C.vec; where_one : C.place; where_other : C.place;
}

let identity read = match optional "id" read with
  | None | Some (Text _) -> ()
  | Some (Number _ as n) -> ignore (number n)
  | Some _ -> malformed "id must be a text or a number"

let horizon value : Q.t * Q.t option =
  let start, last = match value with
    | List [start; last] -> (not_negative start, last)
    | List _ -> malformed "a horizon is null, a number or a pair"
    | last -> (Q.zero, last) in
  match last with
  | Null -> (start, None)
  | last -> let last = number last in form (Q.leq start last) "a horizon that ends before it starts"; (start, Some last)

(* Sets of errors, about the origin; none is the origin. *)
let error_set name read =
  let zero = rational_vector origin in
  match optional name read with
  | None -> C.Ball (zero, rational Q.zero)
  | Some (Object ["ball", r]) -> C.Ball (zero, rational (not_negative r))
  | Some (Object ["box", h]) ->
    let high = vector h in
    C.Box (rational_vector (map_vector Q.neg high), rational_vector high)
  | Some (Object ["factor", f]) -> C.Ellipsoid (zero, rational_matrix (matrix f))
  | Some _ -> malformed "a set of errors is one of ball, box, factor"

(* Planes of a proof for all errors: bounds for each set that the claim has. *)
let rec error_proof sides sets value : C.error_proof =
  match value with
  | Object m when List.assoc_opt "rule" m = Some (Text "plane") ->
    let bounds = List.map (fun name -> name ^ "_at_most") sets in
    let read = fields "the rule plane" (["rule"; "agent_at_most"; "obstacle_at_least"] @ bounds)
        ["n"; "across_w"; "agent_multipliers"; "obstacle_multipliers"] value in
    let n = normal sides read in
    let least name = rational (match optional (name ^ "_at_most") read with Some l -> number l | None -> Q.zero) in
    C.PlaneFor (n, rational (number (field "agent_at_most" read)), rational (number (field "obstacle_at_least" read)),
                least "position_error", least "velocity_error", multipliers "agent" read, multipliers "obstacle" read)
  | Object m when List.assoc_opt "rule" m = Some (Text "groups") ->
    let read = fields "the rule groups" ["rule"; "of"; "runs"; "proofs"] [] value in
    C.GroupsFor (of_agent read, runs (field "runs" read), List.map (error_proof sides sets) (items (field "proofs" read)))
  | Object m when List.assoc_opt "rule" m = Some (Text "times") ->
    let read = fields "the rule times" ["rule"; "cuts"; "proofs"] [] value in
    let cuts = numbers (field "cuts" read) and proofs = items (field "proofs" read) in
    form (List.length proofs = List.length cuts + 1) "times have one proof more than cuts";
    C.TimesFor (cuts, List.map (error_proof sides sets) proofs)
  | Object m when (match List.assoc_opt "rule" m with Some (Text _) -> true | _ -> false) ->
    raise (Refused "plane, groups and times are the rules where there are errors")
  | _ -> malformed "a proof must have a rule"

let verdict says claim proof_read =
  let moves = List.mem says ["out"; "in"; "on"; "depends"] in
  let errors = ["position_error"; "velocity_error"] in
  let read = fields "the claim" (["says"; "agent"; "obstacle"] @ (if moves then ["horizon"] else []))
      (("id" :: (if says = "out" || says = "disjoint" then ["by"] else [])) @ (if List.mem says ["out"; "in"; "depends"] then errors else [])) claim in
  let sets = List.filter (fun name -> List.mem_assoc name read) errors in
  if sets <> [] && says = "in" then unknown "in for all errors";
  identity read;
  let agent, a = body ~moves ~inner:false (field "agent" read) in
  let obstacle, b = body ~moves ~inner:false (field "obstacle" read) in
  let velocity its = if moves then vector (field "velocity" its) else origin in
  let v_a = velocity a and v_b = velocity b in
  let from, until = if moves then horizon (field "horizon" read) else (Q.zero, Some Q.zero) in
  let case = C.{ agent; obstacle; vA = rational_vector v_a; vB = rational_vector v_b;
                 when0 = { from = rational from; until = Option.map rational until } } in
  let by = match optional "by" read with Some d -> not_negative d | None -> Q.zero in
  let claim = match says with
    | "out" | "disjoint" | "depends" -> C.Out (rational by, case)
    | "in" | "overlapping" -> C.InCone case
    | _ -> C.OnCone case in
  form (C.well_formed claim) "a box with low > high, or a shape that is not symmetric and positive definite";
  let opposite = C.{ vx = Q.sub v_a.vx v_b.vx; vy = Q.sub v_a.vy v_b.vy; vz = Q.sub v_a.vz v_b.vz } in
  let sides = { agent_pieces = List.length agent; obstacle_pieces = List.length obstacle; by = Q.sign by > 0; moving_w = opposite } in
  if sets = [] && says <> "depends" then Verdict (says, claim, fun () -> proof sides proof_read)
  else begin
    let positions = error_set "position_error" read and velocities = error_set "velocity_error" read in
    form (C.well_formed_piece positions && C.well_formed_piece velocities) "a box of errors below 0";
    let one name value =
      let read = fields name ["proof"] ["position"; "velocity"] (field name value) in
      let change name = match optional name read with Some x -> vector x | None -> origin in
      let v = change "velocity" in
      let faster = C.{ vx = Q.add opposite.vx v.vx; vy = Q.add opposite.vy v.vy; vz = Q.add opposite.vz v.vz } in
      ((rational_vector (change "position"), rational_vector v), proof { sides with moving_w = faster } (field "proof" read)) in
    let both () =
      let read = fields "the proof" ["rule"; "collides"; "passes"] [] proof_read in
      if text "rule" read <> "errors" then raise (Refused "errors is the rule for depends");
      (one "collides" read, one "passes" read) in
    if says = "depends" then Depends (case, positions, velocities, both)
    else Robust (rational by, case, positions, velocities, fun () -> error_proof sides sets proof_read)
  end

(* Runs. *)

let rec in_order = function a :: (b :: _ as rest) -> Q.lt a b && in_order rest | _ -> true

let few most value = let l = items value in form (List.compare_length_with l most <= 0) (Printf.sprintf "at most %d coefficients" most); l

let track value =
  let read = fields "a track" ["times"; "positions"; "radius"] ["grid"; "turns"] value in
  let grid = match optional "grid" read with Some g -> index 1075 g | None -> 0 in
  let unit = Q.make Z.one (Z.shift_left Z.one grid) in
  let on_grid x = rational (Q.mul unit (number x)) in
  let times = List.map number (items ~least:2 (field "times" read)) in
  let places = List.map (fun segment -> List.map (fun v -> map_vector (fun x -> rational (Q.mul unit x)) (vector v)) (few 16 segment))
      (items (field "positions" read)) in
  let quaternion value = match items value with
    | [w; x; y; z] -> { C.qw = on_grid w; qx = on_grid x; qy = on_grid y; qz = on_grid z }
    | _ -> malformed "a quaternion has four numbers" in
  let not_turned = C.{ qw = rational Q.one; qx = rational Q.zero; qy = rational Q.zero; qz = rational Q.zero } in
  let turns = match optional "turns" read with
    | Some turns -> List.map (fun segment -> List.map quaternion (few 16 segment)) (items turns)
    | None -> List.map (fun _ -> [not_turned]) places in
  let count = List.length places in
  form (List.length times = count + 1 && List.length turns = count) "positions and turns are those of each segment";
  if not (in_order times) then raise (Refused "the times of a track grow");
  let instants = Array.of_list (List.map rational times) in
  let segments = List.mapi (fun i (positions, turns) -> C.{ starts = instants.(i); ends = instants.(i + 1); positions; turns })
      (List.combine places turns) in
  (segments, rational (not_negative (field "radius" read)))

let rec run_proof value : C.run_proof =
  let rule = match value with
    | Object m -> (match List.assoc_opt "rule" m with Some (Text t) -> t | _ -> malformed "a proof must have a rule")
    | _ -> malformed "a proof must have a rule" in
  match rule with
  | "pieces" ->
    let read = fields "the rule pieces" ["rule"; "times"; "planes"] [] value in
    let times = List.map number (items ~least:2 (field "times" read)) in
    let plane value = match items value with
      | [n; long; a; b] ->
        let numbers l = List.map (fun x -> rational (number x)) (few 4 l) in
        { C.its_normal = vector_of n; its_length = rational (not_negative long); at_most_a = numbers a; at_most_b = numbers b }
      | [_; _; _; _; _] | [_; _; _; _; _; _] -> unknown "multipliers in runs"
      | _ -> malformed "a plane of a piece is a list of four to six" in
    let planes = List.map plane (items (field "planes" read)) in
    form (List.length planes = List.length times - 1) "a plane for each piece";
    C.Pieces (rational (List.hd times), List.combine (List.map rational (List.tl times)) planes)
  | "groups" ->
    let read = fields "the rule groups" ["rule"; "of"; "runs"; "proofs"] [] value in
    C.PiecesOf (of_agent read, runs (field "runs" read), List.map run_proof (items (field "proofs" read)))
  | "times" ->
    let read = fields "the rule times" ["rule"; "cuts"; "proofs"] [] value in
    let cuts = numbers (field "cuts" read) and proofs = items (field "proofs" read) in
    form (List.length proofs = List.length cuts + 1) "times have one proof more than cuts";
    C.PartsOfTime (cuts, List.map run_proof proofs)
  | "cover" ->
    let read = fields "the rule cover" ["rule"; "of"; "boxes"; "runs"; "proof"] [] value in
    C.Covered (of_agent read, held (field "boxes" read), runs (field "runs" read), run_proof (field "proof" read))
  | _ -> raise (Refused (rule ^ " is a rule for apart"))

(* The bodies on their tracks. *)
let runners read =
  identity read;
  let bodies = List.map (fun b -> fst (body ~moves:false ~inner:false b)) (items (field "bodies" read)) in
  form (List.for_all C.filled bodies) "a box with low > high, or a shape that is not symmetric and positive definite";
  let tracks = List.map track (items (field "tracks" read)) in
  let count = List.length bodies in
  form (List.length tracks = count) "each body has a track";
  List.map2 (fun its_body (track, radius) -> { C.its_body; track; radius }) bodies tracks

let run claim proof_read =
  let read = fields "the claim" ["says"; "from"; "to"; "bodies"; "tracks"; "by"; "pairs"] ["id"] claim in
  let runners = runners read in
  let count = List.length runners in
  let pair value = match items value with
    | [i; j] ->
      let i = index count i and j = index count j in
      form (i < j) "pairs are [i, j] with i < j";
      (i, j)
    | _ -> malformed "a pair has two indices" in
  let pairs = List.map pair (items (field "pairs" read)) in
  form (List.length (List.sort_uniq compare pairs) = List.length pairs) "a pair twice";
  let claim = {
      C.by_more_than = rational (not_negative (field "by" read));
      start = rational (number (field "from" read));
      finish = rational (number (field "to" read));
      runners;
      pairs = List.map (fun (i, j) -> (Z.of_int i, Z.of_int j)) pairs } in
  let proofs () =
    let whole = fields "the proof" ["rule"; "pairs"] [] proof_read in
    if text "rule" whole <> "pairs" then raise (Refused "pairs is the rule for apart");
    let names = List.map (fun (i, j) -> Printf.sprintf "%d %d" i j) pairs in
    let proofs = fields "pairs" names [] (field "pairs" whole) in
    List.map (fun name -> run_proof (field name proofs)) names in
  Run (claim, proofs)

(* `near`, or `meet`: with the distance 0. *)
let meeting says claim proof_read =
  let read = fields "the claim" (["says"; "from"; "to"; "bodies"; "tracks"; "pair"] @ (if says = "near" then ["by"] else [])) ["id"] claim in
  let all = Array.of_list (runners read) in
  let i, j = match items (field "pair" read) with
    | [i; j] -> (index (Array.length all) i, index (Array.length all) j)
    | _ -> malformed "a pair has two indices" in
  form (i < j) "a pair is [i, j] with i < j";
  let start = number (field "from" read) and finish = number (field "to" read) in
  if not (Q.lt start finish) then raise (Refused "from < to");
  let points = ["point"; "agent_point"; "obstacle_point"] and depths = ["agent_depth"; "obstacle_depth"] in
  let whole = fields "the proof" ["rule"; "time"] (points @ depths @ members) proof_read in
  if List.exists (fun name -> List.mem_assoc name whole) depths then unknown "points at a depth";
  if text "rule" whole <> "point" then raise (Refused ("point is the rule for " ^ says));
  let one = all.(i) and other = all.(j) and time = rational (number (field "time" whole)) in
  let where_one, where_other = where { agent_pieces = List.length one.C.its_body; obstacle_pieces = List.length other.C.its_body;
                                       by = false; moving_w = origin } whole in
  let point who runner its_place = match optional (who ^ "_point") whole, optional "point" whole with
    | Some x, _ | None, Some x -> vector_of x
    | None, None ->
      form (its_place.C.weights <> []) (who ^ ": a point or weights are missing");
      (match C.means_at runner time its_place with
       | x :: _ -> x
       | [] -> raise (Refused (who ^ ": weights are of corners, at a time of the track"))) in
  Meeting { says; no_farther = rational (match optional "by" read with Some d -> not_negative d | None -> Q.zero);
            start = rational start; finish = rational finish; one; other; time;
            point_one = point "agent" one where_one; point_other = point "obstacle" other where_other; where_one; where_other }

let rec fit_proof pieces value : C.fit_proof =
  match value with
  | Object m when List.assoc_opt "rule" m = Some (Text "vertices") ->
    C.Vertices (piece_of pieces "obstacle_piece" (fields "the rule vertices" ["rule"] ["obstacle_piece"] value))
  | Object m when List.assoc_opt "rule" m = Some (Text "groups") ->
    let read = fields "the rule groups" ["rule"; "of"; "runs"; "proofs"] [] value in
    C.Parts (of_agent read, runs (field "runs" read), List.map (fit_proof pieces) (items (field "proofs" read)))
  | Object m when (match List.assoc_opt "rule" m with Some (Text _) -> true | _ -> false) -> raise (Refused "no rule for inside")
  | _ -> malformed "a proof must have a rule"

let fit claim proof_read =
  let read = fields "the claim" ["says"; "agent"; "obstacle"] ["id"] claim in
  identity read;
  let one name = fst (body ~moves:false ~inner:false (field name read)) in
  let agent = one "agent" and obstacle = one "obstacle" in
  form (C.filled agent && C.filled obstacle) "a box with low > high, or a matrix that is not as it must be";
  Fit (agent, obstacle, fun () -> fit_proof (List.length obstacle) proof_read)

let statement value =
  let answer, value = match value with
    | Object members when List.mem_assoc "certificate" members && not (List.mem_assoc "format" members) ->
      (Some members, List.assoc "certificate" members)
    | _ -> (None, value) in
  let read = fields "a certificate" ["format"; "version"; "claim"; "proof"] [] value in
  form (field "format" read = Text "vericone-certificate") "the format must be vericone-certificate";
  form (field "version" read = Number "1") "the version must be 1";
  let claim = field "claim" read in
  let says = match claim with
    | Object members -> (match List.assoc_opt "says" members with Some (Text t) -> t | _ -> malformed "a claim must say something")
    | _ -> malformed "a claim is missing" in
  let found = match says with
    | "out" | "in" | "on" | "disjoint" | "overlapping" | "touching" | "depends" -> verdict says claim (field "proof" read)
    | "apart" -> run claim (field "proof" read)
    | "meet" | "near" -> meeting says claim (field "proof" read)
    | "inside" -> fit claim (field "proof" read)
    | "passed" | "stays" -> unknown ("the claim " ^ says)
    | _ -> malformed ("an unknown claim: " ^ says) in
  (match answer with
   | Some members ->
     let unsure = match found with Depends _ | Robust _ -> List.mem_assoc "robust" members | _ -> false in
     (match List.assoc_opt (if unsure then "robust" else "verdict") members with
      | None -> ()
      | Some verdict -> if verdict <> Text says then raise (Refused "the answer's verdict is that of its certificate"))
   | None -> ());
  found
