"""Items of fixed sizes that go down a potential until they are at rest."""
