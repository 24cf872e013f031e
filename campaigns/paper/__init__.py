"""The paper's tables and figures, made again by one command, each of its claims with a verdict.

printed      what the paper prints: its figures, its equations where they can be put to the proof, its words in ours
sizes        how much is run: the whole, or quickly
stages       work that is kept as it is done, so that an interrupted run goes on where it was
functions, search       Tables 1 and 3: the benchmark functions, and the searches on them
worlds                  Table 2 and Fig. 5: the planners, and their plans flown
holding, controllers    Fig. 6: the printed gains in wind; laws and optimisers tuned alike
equations               what follows from the equations as they are printed
claims       each claim as a row; its verdict is computed from the results, never written by hand
verdicts, planner_rules, search_rules, gain_rules       what computes them
figures      the pictures
page         the page; it has no figure that is not in the results
run          all of it, in order

    from campaigns.paper.run import make_paper
    make_paper(sizes.QUICK, Path("paper"), local(2), print)
"""
