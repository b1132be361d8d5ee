# SPDX-License-Identifier: MIT
"""From the rows of `grove bench` and logs of runs to figures, tables and one page.

rows        reading results, and what is wrong with them
logs        reading logs of single runs
groups      what has something in common
lines       what gets a line of its own in a figure: method, omega, time limit
metrics     success, runtime, SQR, PAR-2, ... of a set of rows
anytime     quality over time
speedup     times of the baselines over those of the other methods
proofs      claims that contradict each other, and false ones of other solvers
plans       plans of classical MAPF, from their files
tracker     MAPF Tracker: rows out, best known costs and bounds in
style       colours and markers
figures     the plots of methods compared (they and curves alone need matplotlib)
curves      those as wide as a column: success over agents, quality over time, single runs
tables      a table as CSV and as HTML
report      what the tables and figures of a report are
page        the HTML page
cli         the command line
"""
