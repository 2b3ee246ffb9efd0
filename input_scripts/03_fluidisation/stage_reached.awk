# stages.txt (stage, time of its start, stage before) to script variables: the stage that the water's time `now` is in.
$2 <= now * (1 + 1e-9) { stage = $1; start = $2; from = $3; found = 1 }
END {
  if (found) printf "variable stage_reached equal %s\nvariable stage_start equal %s\nvariable from equal %s\n", stage, start, from
  else print "variable stage_reached equal 0"
}
