# Mean speed of settling as a script variable: of the fall from 0.75 to 0.5 of the first height, times interpolated between samples.
# Columns time_s, height_m, ...
NR == 2 { first = $2 }
NR > 2 {
  for (k = 1; k <= 2; ++k) {
    level = (k == 1 ? 0.75 : 0.5) * first
    if (last >= level && $2 < level) at[k] = before + ($1 - before) * (last - level) / (last - $2)
  }
}
NR > 1 { before = $1; last = $2 }
END { if (at[2] > at[1]) printf "variable settling_speed equal %.8g\n", 0.25 * first / (at[2] - at[1]) }
