# flow.csv to script variables: the gradient at which a layer's fines content has first changed by a twentieth of itself, and those at
# which the fines that have left pass 0.2, 1 and 5 % of all fines (0: never); the largest gradient of a layer over the mean, after
# the first tenth of the samples.
NR == 1 { for (k = 1; k <= NF; k++) column[$k] = k; while (("fines_share_layer_" (layers + 1)) in column) ++layers; next }
{
  lost = $column["eroded_fines_share"]; gradient = $column["applied_gradient"]
  for (n = 1; n <= 3; n++)
    if (!(n in at) && lost >= (n == 1 ? 0.002 : n == 2 ? 0.01 : 0.05)) at[n] = gradient
  ++samples; mean[samples] = 0; most[samples] = 0
  for (k = 1; k <= layers; k++) {
    share = $column["fines_share_layer_" k]; local = $column["hydraulic_gradient_layer_" k]
    if (samples == 1) first[k] = share
    if (!inside && first[k] > 0 && (share / first[k] > 1.05 || share / first[k] < 0.95)) inside = gradient
    mean[samples] += local / layers
    if (k == 1 || local > most[samples]) most[samples] = local
  }
}
END {
  for (n = int(samples / 10) + 1; n <= samples; n++) if (mean[n] > 0 && most[n] / mean[n] > steepest) steepest = most[n] / mean[n]
  printf "variable onset_inside equal %s\nvariable steepest_layer equal %s\n", inside + 0, steepest + 0
  printf "variable onset_2_permille equal %s\nvariable onset_1_percent equal %s\nvariable onset_5_percent equal %s\n", at[1] + 0, at[2] + 0, at[3] + 0
}
