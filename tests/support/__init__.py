"""The test bench: real OctoPrint servers, their users, their push messages and a browser."""
