# flow.csv to script variables: what expected.csv has values for. As suffuse-analyse fluidisation, from single samples: the gradient
# is the mean of the layers'; conductivity and the stress of the lowest layer are least-squares lines through the samples from 0.2
# to 0.8 of the critical gradient (-v critical=...). Stress vanishes where the gradient above the middle of that layer says so.
NR == 1 {
  for (k = 1; k <= NF; ++k) column[$k] = k
  while (("hydraulic_gradient_layer_" (layers + 1)) in column) ++layers
  next
}
{
  sum = 0
  for (k = 1; k <= layers; ++k) { layer[k] = $column["hydraulic_gradient_layer_" k]; sum += layer[k] }
  mean = sum / layers
  if (NR == 2) {
    porosity = $column["bed_porosity"]
    sauter = ("sauter_diameter_m" in column) ? $column["sauter_diameter_m"] : 3.478e-4
    top = $column["coordination_layer_1"]; bottom = $column["coordination_layer_" layers]
  }
  if (mean > 0.8 * critical) passed = 1
  if (passed || mean < 0.2 * critical) next
  ++n
  above = (sum - 0.5 * layer[layers]) / (layers - 0.5)
  stress = $column["effective_stress_ratio_" layers]; speed = $column["superficial_velocity_z_m_per_s"]
  i += mean; ii += mean * mean; v += speed; iv += mean * speed
  a += above; aa += above * above; s += stress; as += above * stress
}
END {
  slope = (n * as - a * s) / (n * aa - a * a)
  printf "variable samples equal %d\nvariable measured_porosity equal %.8g\n", n, porosity
  printf "variable stress_gradient equal %.8g\nvariable conductivity equal %.8g\n", a / n - s / n / slope, (n * iv - i * v) / (n * ii - i * i)
  printf "variable measured_sauter equal %.8g\n", sauter
  printf "variable coordination_top equal %.8g\nvariable coordination_bottom equal %.8g\n", top, bottom
}
