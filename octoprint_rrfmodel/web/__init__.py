"""HTTP and push: what pages and programs ask for."""
