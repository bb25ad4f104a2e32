# The bound E = A (13u r + 6u L)(r + 11u L) as it is evaluated: at most 12u off, whatever its constants are.
# X, Y, Z stand for 13u r, 6u L and 11u L, whose factors are exact numbers.
@rnd = float<ieee_64, ne>;

a = rnd(a_); r = rnd(r_); f = rnd(f_); g = rnd(g_); h = rnd(h_);
p = rnd(p_); q = rnd(q_); v = rnd(v_);     # |o_i| as computed
l = p + q + v;
lh = rnd(rnd(p + q) + v);
m = f * r + g * l;
mh = rnd(rnd(f * r) + rnd(g * lh));
n = r + h * l;
nh = rnd(r + rnd(h * lh));
e = a * (m * n);
eh = rnd(a * rnd(mh * nh));

{ a in [1b-298, 1b257] /\ r in [1b-149, 1b128] /\ p in [1b-149, 1b129] /\ q in [1b-149, 1b129] /\ v in [1b-149, 1b129]
  /\ f in [1b-53, 1b-48] /\ g in [1b-53, 1b-48] /\ h in [1b-53, 1b-48]
  -> lh -/ l in [-131073b-69, 131073b-69] /\ mh -/ m in [-5b-53, 5b-53] /\ nh -/ n in [-5b-53, 5b-53] /\ eh -/ e in [-12b-53, 12b-53] }
