"""Small plugins that offer what those of others do, for servers of the tests."""
