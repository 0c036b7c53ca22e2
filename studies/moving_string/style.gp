# What the figures of the shaft's studies share. Needs `output`; `width` and `height` in pixels.
set terminal svg size width,height font "sans-serif,15" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set datafile missing NaN
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
set key noautotitle

csv(name) = data . name . ".csv"
red = "#a63603"; blue = "#08519c"; light = "#6baed6"; grey = "#777777"; green = "#238b45"
