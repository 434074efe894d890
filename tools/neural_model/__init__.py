"""Makes the neural model that comes with Lipwright: speech, faces, bad rooms, and a net."""
