# flow.csv to script variables: the gradient at which the fines that have left pass 0.2, 1 and 5 % of all fines (0: never).
NR == 1 { for (k = 1; k <= NF; k++) column[$k] = k; next }
{
  lost = $column["eroded_fines_share"]; gradient = $column["applied_gradient"]
  for (n = 1; n <= 3; n++)
    if (!(n in at) && lost >= (n == 1 ? 0.002 : n == 2 ? 0.01 : 0.05)) at[n] = gradient
}
END {
  printf "variable onset_2_permille equal %s\nvariable onset_1_percent equal %s\nvariable onset_5_percent equal %s\n", at[1] + 0, at[2] + 0, at[3] + 0
}
