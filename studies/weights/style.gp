# What all figures of this study share, beside what all studies do.
load folder . "/../style.gp"
kinds = "ALE-RANCF ALE-ANCF"
transfers = "nodal projected conservative"
colour(i) = i == 1 ? "#a63603" : i == 2 ? "#4292c6" : "#08519c"
mark(i) = i == 1 ? 5 : i == 2 ? 6 : 7
is(kind, transfer) = (strcol("element") eq kind && strcol("velocities") eq transfer) ? 1 : NaN
