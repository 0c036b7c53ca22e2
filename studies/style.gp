# What all figures share. Needs `output`; `width` and `height` in pixels.
set terminal svg size width,height font "sans-serif,15" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
set key noautotitle

csv(name) = data . name . ".csv"
