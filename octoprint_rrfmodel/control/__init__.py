"""Commands to the machine from a person or a program, checked and handed to the link."""
