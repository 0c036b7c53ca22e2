# What all figures of this study share. Needs `output`; `width` and `height` in pixels.
set terminal svg size width,height font "sans-serif,15" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
set key noautotitle

csv(name) = data . name . ".csv"
kinds = "ALE-RANCF ALE-ANCF"
transfers = "nodal projected conservative"
colour(i) = i == 1 ? "#a63603" : i == 2 ? "#4292c6" : "#08519c"
mark(i) = i == 1 ? 5 : i == 2 ? 6 : 7
is(kind, transfer) = (strcol("element") eq kind && strcol("velocities") eq transfer) ? 1 : NaN
