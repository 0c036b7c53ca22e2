# What the figures of the shaft's studies share, beside what all studies do.
load folder . "/../style.gp"
set datafile missing NaN

red = "#a63603"; blue = "#08519c"; light = "#6baed6"; grey = "#777777"; green = "#238b45"
