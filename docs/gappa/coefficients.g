# A, R = A r^2 and C's squares: sums and products of squares of binary32, which are exact in binary64.
# A's 2u, R's 3u and 3u for the sum of the squares of three computed numbers, u = 2^-53, with what the second
# order adds. All are relative, for any numbers from 0 to the end of the range.
@rnd = float<ieee_64, ne>;

x = rnd(x_); y = rnd(y_); z = rnd(z_);     # d_i^2
a = x + y + z;
ah = rnd(rnd(x + y) + z);

q = rnd(q_);                               # r^2
r = a * q;
rh = rnd(ah * q);

k = rnd(k_); l = rnd(l_); m = rnd(m_);     # the computed components of o x d
kk = k * k + l * l + m * m;
kkh = rnd(rnd(rnd(k * k) + rnd(l * l)) + rnd(m * m));

{ x in [1b-298, 1b257] /\ y in [1b-298, 1b257] /\ z in [1b-298, 1b257] /\ q in [1b-298, 1b257]
  /\ |k| in [1b-298, 1b260] /\ |l| in [1b-298, 1b260] /\ |m| in [1b-298, 1b260]
  -> ah -/ a in [-131073b-69, 131073b-69]
  /\ rh -/ r in [-196609b-69, 196609b-69]
  /\ kkh -/ kk in [-196609b-69, 196609b-69] }
