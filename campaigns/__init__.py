"""Many flights: campaigns over sweeps of conditions, tuning by flights, and the paper's results flown again.

sweep    SWEEP.yaml, read and checked, becomes runs: every combination of its axes, or a sample of them
runs     what one flight is, and its id: the same run is the same flight, to the byte
flying   a run becomes a row of figures, anywhere
store    the folder of a campaign: what is done is never lost and never done twice
campaign the whole of it: flown, recorded where wanted, tables written
table    the rows as Parquet
sofar    the rows at any moment; `show` groups them, `clusters` gathers failures by kind, `plots` draws

`executors` does work for many items in processes of this machine or of others. This package stands on top: it imports
all the others, and only `companion.cli` imports it.
"""
