# Mean of the force along y over the last tenth of the samples, and its change over it, as script variables: columns time_s,
# solid_force_x_n, solid_force_y_n, ...
NR > 1 { force[++n] = $3 }
END {
  first = n - int(n / 10) + 1
  for (k = first; k <= n; ++k) sum += force[k]
  printf "variable force equal %.8g\nvariable change equal %.8g\n", sum / (n - first + 1), force[n] / force[first] - 1
}
