# One coordinate of o, its products and squares: each computed number relative to the exact one, u = 2^-53.
# o = p - c rounds once; a product adds one rounding, a square two more than o's, a sum of three such squares two.
@rnd = float<ieee_64, ne>;

p = float<ieee_32, ne>(p_); c = float<ieee_32, ne>(c_); d = float<ieee_32, ne>(d_);
o = p - c;
oh = rnd(o);
t = o * d;
th = rnd(oh * d);                          # a product of o_j and d_k, in o x d and in b

s = o * o;
sh = rnd(oh * oh);

x = rnd(x_); y = rnd(y_); z = rnd(z_);     # computed squares, of which the sum has two roundings
oo = x + y + z;
ooh = rnd(rnd(x + y) + z);

{ |o| in [1b-149, 1b129] /\ |d| in [1b-149, 1b128]
  /\ x in [1b-298, 1b258] /\ y in [1b-298, 1b258] /\ z in [1b-298, 1b258]
  -> th -/ t in [-131073b-69, 131073b-69]        # 2u
  /\ sh -/ s in [-196609b-69, 196609b-69]        # 3u
  /\ ooh -/ oo in [-131073b-69, 131073b-69] }    # 2u: 5u for |o|^2 together
