# Largest speed and its time as script variables: columns time_s, speed_m_per_s, gap_m.
NR > 1 && $2 > peak { peak = $2; time = $1 }
END { printf "variable peak equal %.8g\nvariable peak_time equal %.8g\n", peak, time }
