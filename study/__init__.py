"""The paper's study on our version of its test environment: see scripts/reproduce."""
