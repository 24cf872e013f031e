"""What leads to what when something goes wrong: the table (being filled)."""
