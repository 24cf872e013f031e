"""What the vehicle sees: a rolling map of what stands, and tracks of what moves.

`sensing` turns messages into scans, `rollingmap` keeps the cells that are taken, `tracks` what is on its way, `sight`
puts them together and is the way in. All places are in the mission frame (NED, [m]).
"""
