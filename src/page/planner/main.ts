// The entry point of the planner.
