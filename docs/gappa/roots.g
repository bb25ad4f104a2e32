# From b and s to the two ends of a direct root, (-b - s)(1 - 2^-36)/A and (-b - s)(1 + 2^-36)/A: fewer than 8u off
# for the b and the s that were computed; A is the computed one, good to 2u. And the two quotients of the q-form.
@rnd = float<ieee_64, ne>;

b = rnd(b_); s = rnd(s_); c = rnd(c_);
ah = rnd(ah_);
inverse = rnd(1 / ah);
less = rnd((1 - 1b-36) * inverse);
more = rnd((1 + 1b-36) * inverse);
n = b + s;                                 # of either sign
nh = rnd(n);
lessh = rnd(nh * less);
moreh = rnd(nh * more);

d = rnd(d_);
root = rnd(sqrt(d));

qh = rnd(q_);
great = rnd(qh / ah);
small = rnd(c / qh);

{ ah in [1b-298, 1b257] /\ a in [1b-298, 1b257] /\ ah -/ a in [-131073b-69, 131073b-69]
  /\ |n| in [1b-400, 1b260] /\ |b| in [1b-400, 1b260] /\ |s| in [1b-400, 1b260]
  /\ d in [1b-596, 1b520] /\ |qh| in [1b-400, 1b261] /\ |c| in [1b-400, 1b260]
  -> lessh -/ (n * ((1 - 1b-36) * (1 / a))) in [-8b-53, 8b-53]
  /\ moreh -/ (n * ((1 + 1b-36) * (1 / a))) in [-8b-53, 8b-53]
  /\ root -/ sqrt(d) in [-1b-53, 1b-53]
  /\ great -/ (qh / a) in [-196610b-69, 196610b-69]
  /\ small -/ (c / qh) in [-1b-53, 1b-53] }
