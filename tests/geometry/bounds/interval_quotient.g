# Interval::operator/: with q = fl(|xm| / |ym|) the radius, computed to nearest, is at least
# (xr + (|xm| / |ym|) yr) / (|ym| - yr) + u q, which bounds |x / y - q|. a = |xm|, b = |ym|, r = xr, s = yr; d stands for
# the code's (|ym| - yr) (1 - 2^-49), which is below |ym| - yr: two roundings take back at most 2^-52 of it.
@rnd = float<ieee_64, ne>;
a = rnd(a_); b = rnd(b_); r = rnd(r_); s = rnd(s_); d = rnd(d_); t = rnd(t_);
q rnd= a / b;
total rnd= (r + q * s) / d + 1b-53 * q;
exact = (r + (a / b) * s) / d + 1b-53 * (a / b);
product = t * 1125899906842626b-50;
inflated = rnd(product);

{ a in [1b-200, 1b200] /\ b in [1b-200, 1b200] /\ r in [1b-200, 1b200] /\ s in [1b-200, 1b200] /\ d in [1b-200, 1b200] /\ t in [1b-900, 1b900]
  -> total -/ exact in [-3b-52, 3b-52]
  /\ inflated -/ product in [-1b-53, 1b-53]
  /\ (1 + 1b-49) * (1 - 1b-53) * (1 - 3b-52) - 1 in [0, 1b-48] }
