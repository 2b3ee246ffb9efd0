# permeability.csv to script variables: the last superficial velocity along the direction, and by which share of it the row before
# differs.
NR == 1 {
  for (k = 1; k <= NF; ++k) if ($k == "superficial_velocity_" direction "_m_per_s") column = k
  next
}
{ before = last; last = $column }
END { printf "variable velocity equal %.12g\nvariable last_change equal %.3g\n", last, (last - before) / last }
