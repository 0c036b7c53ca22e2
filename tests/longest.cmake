# Read by ctest behind its list of tests: these start first, so that no core waits for a long one at the end.
set_tests_properties(All/ConvergedScenes.UncertaintyCoversTheTrueError/drill_string_in_curved_well PROPERTIES COST 1000 TIMEOUT 900)
set_tests_properties(WhatGoesTogether.IsWhatTheDocsSay PROPERTIES COST 500)
