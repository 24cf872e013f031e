"""Several vehicles: what each means to fly, told to the others, and what the others mean to fly."""
