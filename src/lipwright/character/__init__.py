"""Characters: from controls to what a rig has."""
