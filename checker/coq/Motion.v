(* What is claimed of runs: bodies that move and turn along tracks, within tubes. *)
From Vericone Require Export Bodies.
Require Export ZArith.
Open Scope R_scope.

(* The row of Pascal's triangle with n + 1 entries. *)
Fixpoint neighbours (l : list Z) : list Z :=
  match l with a :: ((b :: _) as r) => (a + b)%Z :: neighbours r | _ => [1%Z] end.
Fixpoint binomials (n : nat) : list Z := match n with O => [1%Z] | S n => 1%Z :: neighbours (binomials n) end.

(* c_0 s^N + c_1 s^(N-1) t + ... + c_N t^N *)
Fixpoint sum_form (cs : list R) (s t : R) : R :=
  match cs with [] => 0 | c :: cs => c * s ^ length cs + t * sum_form cs s t end.

(* The polynomial with Bernstein coefficients bs: the sum of binomial(N, k) b_k (1 - u)^(N-k) u^k. *)
Definition bernstein (bs : list R) (u : R) : R :=
  sum_form (map (fun p => IZR (fst p) * snd p) (combine (binomials (pred (length bs))) bs)) (1 - u) u.

Record quaternion (T : Type) := Quaternion { qw : T; qx : T; qy : T; qz : T }.
Arguments Quaternion {T}. Arguments qw {T}. Arguments qx {T}. Arguments qy {T}. Arguments qz {T}.

Definition square (q : quaternion R) : R := qw q * qw q + qx q * qx q + qy q * qy q + qz q * qz q.
(* N(q) / q.q is the rotation of q / |q|. *)
Definition rotation (q : quaternion R) : mat R :=
  let (w, x, y, z) := q in
  Rows (Vec (w*w + x*x - y*y - z*z) (2 * (x*y - w*z)) (2 * (x*z + w*y)))
       (Vec (2 * (x*y + w*z)) (w*w - x*x + y*y - z*z) (2 * (y*z - w*x)))
       (Vec (2 * (x*z - w*y)) (2 * (y*z + w*x)) (w*w - x*x - y*y + z*z)).

(* From one time to another: coefficients of the position and of a quaternion. *)
Record segment (T : Type) := Segment
  { starts : T; ends : T; positions : list (vec T); turns : list (quaternion T) }.
Arguments Segment {T}. Arguments starts {T}. Arguments ends {T}. Arguments positions {T}. Arguments turns {T}.

Definition position (g : segment R) (t : R) : vec R :=
  let u := (t - starts g) / (ends g - starts g) in
  Vec (bernstein (map vx (positions g)) u) (bernstein (map vy (positions g)) u) (bernstein (map vz (positions g)) u).
Definition turned (g : segment R) (t : R) : quaternion R :=
  let u := (t - starts g) / (ends g - starts g) in
  Quaternion (bernstein (map qw (turns g)) u) (bernstein (map qx (turns g)) u)
             (bernstein (map qy (turns g)) u) (bernstein (map qz (turns g)) u).

(* Where the point a of a body is at the time t. *)
Definition placed (g : segment R) (t : R) (a : vec R) : vec R :=
  add (position g t) (scale (/ square (turned g t)) (mul (rotation (turned g t)) a)).

(* A body on its track; the radius of the tube. *)
Record runner (T : Type) := Runner { its_body : body T; track : list (segment T); radius : T }.
Arguments Runner {T}. Arguments its_body {T}. Arguments track {T}. Arguments radius {T}.

(* On any stretch of time on which each of the two is on one segment, the two turn by rotations, and what is within the
   radii of points of the two bodies is farther apart than d. *)
Definition apart (d from to : R) (A B : runner R) : Prop :=
  forall f g u v t, In f (track A) -> In g (track B) -> from <= u -> u < v -> v <= to -> u <= t <= v ->
  starts f <= u -> v <= ends f -> starts g <= u -> v <= ends g ->
  0 < square (turned f t) /\ 0 < square (turned g t) /\
  forall a b x y, within_body (its_body A) a -> within_body (its_body B) b ->
    near (radius A) (sub x (placed f t a)) -> near (radius B) (sub y (placed g t b)) ->
    d * d < dot (sub x y) (sub x y).
