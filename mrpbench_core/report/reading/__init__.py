"""Results folders as columns of numbers: which runs count, what each column means, what sets configurations apart."""
