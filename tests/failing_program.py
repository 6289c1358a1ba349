"""A program of two moves that counts its rounds, for controllers that fail."""

PROGRAM = """MODULE failing
  PERS num rounds := 0;
  PROC main()
    MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, z10, tool0;
    MoveAbsJ [[0,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;
    rounds := rounds + 1;
  ENDPROC
ENDMODULE
"""
