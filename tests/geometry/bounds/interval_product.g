# Interval::operator*: the radius, computed to nearest, is at least |xm| yr + xr (|ym| + yr) + u |xm ym|, which bounds
# |x y - fl(xm ym)|. a = |xm|, b = |ym|, r = xr, s = yr, where nothing leaves the normal numbers; the losses where
# something does are below 5 * 2^-1075, and the code adds 2^-1000.
@rnd = float<ieee_64, ne>;
a = rnd(a_); b = rnd(b_); r = rnd(r_); s = rnd(s_); t = rnd(t_);
total rnd= (a * s + r * (b + s)) + 1b-53 * (a * b);
exact = (a * s + r * (b + s)) + 1b-53 * (a * b);
product = t * 1125899906842626b-50;
inflated = rnd(product);

{ a in [1b-400, 1b400] /\ b in [1b-400, 1b400] /\ r in [1b-400, 1b400] /\ s in [1b-400, 1b400] /\ t in [1b-900, 1b900]
  -> total -/ exact in [-9b-54, 9b-54]
  /\ inflated -/ product in [-1b-53, 1b-53]
  /\ (1 + 1b-49) * (1 - 1b-53) * (1 - 9b-54) - 1 in [0, 1b-48] }
