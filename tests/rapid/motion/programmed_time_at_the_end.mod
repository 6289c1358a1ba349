! RAPID Instructions, MoveAbsJ: a last fly-by move keeps its \T, though the program has ended.
MODULE programmed_time_at_the_end
  CONST extjoint none:=[9E9,9E9,9E9,9E9,9E9,9E9];

  PROC main()
    ! Were one of them slower than it says by a hundredth, that would be K612.
    MoveAbsJ [[0,0,0,0,30,0],none],v10,fine,tool0;
    MoveAbsJ [[3,0,0,0,30,0],none],v10\T:=0.3,z10,tool0;
    MoveAbsJ [[6,0,0,0,30,0],none],v10\T:=0.3,z10,tool0;
    MoveAbsJ [[9,0,0,0,30,0],none],v10\T:=0.3,z10,tool0;
    MoveAbsJ [[12,0,0,0,30,0],none],v10\T:=0.3,z10,tool0;
  ENDPROC
ENDMODULE
