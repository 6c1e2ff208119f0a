(* Texts in JSON, strictly: what is not JSON, or has a field twice, is refused. Numbers stay as they are written. *)

exception Malformed of string
let malformed words = raise (Malformed words)
let form true_ words = if not true_ then malformed words

type t =
  | Null
  | Bool of bool
  | Number of string
  | Text of string
  | List of t list
  | Object of (string * t) list

let deepest = 500

(* Whether the bytes are UTF-8 as it is defined: no overlong forms, no surrogates. *)
let is_utf8 s =
  let size = String.length s in
  let byte i = if i < size then Char.code s.[i] else 0 in
  let continues i = byte i land 0xC0 = 0x80 in
  let rec from i =
    if i >= size then true
    else
      let a = byte i and b = byte (i + 1) in
      if a < 0x80 then from (i + 1)
      else if a < 0xC2 then false
      else if a < 0xE0 then continues (i + 1) && from (i + 2)
      else if a < 0xF0 then
        continues (i + 1) && continues (i + 2)
        && (a <> 0xE0 || b >= 0xA0) && (a <> 0xED || b < 0xA0) && from (i + 3)
      else
        a < 0xF5 && continues (i + 1) && continues (i + 2) && continues (i + 3)
        && (a <> 0xF0 || b >= 0x90) && (a <> 0xF4 || b < 0x90) && from (i + 4)
  in
  from 0

let add_utf8 buffer code = Buffer.add_utf_8_uchar buffer (Uchar.of_int code)

(* Reads one value from i on: the value and where it ends. *)
let value s start =
  let size = String.length s in
  let peek i = if i < size then s.[i] else '\000' in
  let rec space i = if i < size && (match s.[i] with ' ' | '\t' | '\n' | '\r' -> true | _ -> false) then space (i + 1) else i in
  let expect c i = if i < size && s.[i] = c then i + 1 else malformed (Printf.sprintf "no JSON: %C is missing at byte %d" c i) in
  let word text value i =
    let n = String.length text in
    if i + n <= size && String.sub s i n = text then (value, i + n) else malformed (Printf.sprintf "no JSON at byte %d" i) in
  let rec digits i = if i < size && s.[i] >= '0' && s.[i] <= '9' then digits (i + 1) else i in
  let some_digits i = let j = digits i in form (j > i) (Printf.sprintf "no JSON: a digit is missing at byte %d" i); j in
  let number i =
    let j = if peek i = '-' then i + 1 else i in
    let j = if peek j = '0' then j + 1 else some_digits j in
    let j = if peek j = '.' then some_digits (j + 1) else j in
    let j = match peek j with
      | 'e' | 'E' -> some_digits (match peek (j + 1) with '+' | '-' -> j + 2 | _ -> j + 1)
      | _ -> j in
    (Number (String.sub s i (j - i)), j) in
  let hex i =
    form (i + 4 <= size) "no JSON: an escape is cut off";
    let code = ref 0 in
    for k = i to i + 3 do
      code := !code * 16 + (match s.[k] with
        | '0' .. '9' as c -> Char.code c - 48
        | 'a' .. 'f' as c -> Char.code c - 87
        | 'A' .. 'F' as c -> Char.code c - 55
        | _ -> malformed "no JSON: an escape without its four digits")
    done;
    !code in
  let text i =
    let buffer = Buffer.create 16 in
    let rec from i =
      form (i < size) "no JSON: a text without its end";
      match s.[i] with
      | '"' -> i + 1
      | '\\' ->
        (match peek (i + 1) with
         | '"' | '\\' | '/' as c -> Buffer.add_char buffer c; from (i + 2)
         | 'b' -> Buffer.add_char buffer '\b'; from (i + 2)
         | 'f' -> Buffer.add_char buffer '\012'; from (i + 2)
         | 'n' -> Buffer.add_char buffer '\n'; from (i + 2)
         | 'r' -> Buffer.add_char buffer '\r'; from (i + 2)
         | 't' -> Buffer.add_char buffer '\t'; from (i + 2)
         | 'u' ->
           let code = hex (i + 2) in
           if code >= 0xD800 && code < 0xDC00 then begin
             form (peek (i + 6) = '\\' && peek (i + 7) = 'u') "no text: half a pair of escapes";
             let low = hex (i + 8) in
             form (low >= 0xDC00 && low < 0xE000) "no text: half a pair of escapes";
             add_utf8 buffer (0x10000 + ((code - 0xD800) lsl 10) + (low - 0xDC00));
             from (i + 12)
           end else begin
             form (code < 0xDC00 || code >= 0xE000) "no text: half a pair of escapes";
             add_utf8 buffer code;
             from (i + 6)
           end
         | _ -> malformed "no JSON: an unknown escape")
      | c ->
        form (c >= ' ') "no JSON: a control character in a text";
        Buffer.add_char buffer c;
        from (i + 1) in
    let j = from i in
    (Buffer.contents buffer, j) in
  let rec any depth i =
    form (depth < deepest) "nested too deeply";
    let i = space i in
    form (i < size) "no JSON: it ends too early";
    match s.[i] with
    | '{' ->
      let i = space (i + 1) in
      if peek i = '}' then (Object [], i + 1) else members depth (Hashtbl.create 8) [] i
    | '[' ->
      let i = space (i + 1) in
      if peek i = ']' then (List [], i + 1) else elements depth [] i
    | '"' -> let read, j = text (i + 1) in (Text read, j)
    | 't' -> word "true" (Bool true) i
    | 'f' -> word "false" (Bool false) i
    | 'n' -> word "null" Null i
    | '-' | '0' .. '9' -> number i
    | _ -> malformed (Printf.sprintf "no JSON at byte %d" i)
  and members depth names found i =
    let i = expect '"' (space i) in
    let name, i = text i in
    form (not (Hashtbl.mem names name)) "a field twice";
    Hashtbl.add names name ();
    let i = expect ':' (space i) in
    let read, i = any (depth + 1) i in
    let i = space i in
    if peek i = ',' then members depth names ((name, read) :: found) (i + 1)
    else (Object (List.rev ((name, read) :: found)), expect '}' i)
  and elements depth found i =
    let read, i = any (depth + 1) i in
    let i = space i in
    if peek i = ',' then elements depth (read :: found) (i + 1) else (List (List.rev (read :: found)), expect ']' i) in
  let read, i = any 0 start in
  (read, space i)

let parse s =
  form (is_utf8 s) "no UTF-8";
  let read, i = value s 0 in
  form (i = String.length s) (Printf.sprintf "no JSON: something follows at byte %d" i);
  read
