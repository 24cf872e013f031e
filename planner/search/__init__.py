"""Optimisers. Each is ask/tell: it proposes candidates and is told their costs; it never calls the cost itself."""
