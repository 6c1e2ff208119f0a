# Interval::operator+: the radius, computed to nearest, is at least r + s + u |m|, u = 2^-53. m, r, s = |midpoint|
# and the radii of the operands. `total` falls short by at most a factor 1 - 2^-51, and kInflate = 1 + 2^-49, itself
# rounded, makes up for it. (A sum of two doubles that leaves the normal numbers is exact.)
@rnd = float<ieee_64, ne>;
m = rnd(m_); r = rnd(r_); s = rnd(s_); t = rnd(t_);
total rnd= (r + s) + 1b-53 * m;
exact = (r + s) + 1b-53 * m;
product = t * 1125899906842626b-50;
inflated = rnd(product);

{ m in [1b-400, 1b400] /\ r in [1b-400, 1b400] /\ s in [1b-400, 1b400] /\ t in [1b-900, 1b900]
  -> total -/ exact in [-1b-51, 1b-51]
  /\ inflated -/ product in [-1b-53, 1b-53]
  /\ (1 + 1b-49) * (1 - 1b-53) * (1 - 1b-51) - 1 in [0, 1b-48] }
