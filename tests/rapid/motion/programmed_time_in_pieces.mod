! RAPID Instructions, MoveAbsJ: \T holds for fly-by moves that are planned one by one, and for the last.
MODULE programmed_time_in_pieces
  CONST extjoint none:=[9E9,9E9,9E9,9E9,9E9,9E9];
  VAR clock watch;

  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],none],v10,fine,tool0;
    ClkStart watch;
    there;
    TPWrite "about 1.2 s: "\Bool:=Abs(ClkRead(watch)-1.2)<0.25;   ! -> about 1.2 s: TRUE
    MoveAbsJ [[0,0,0,0,30,0],none],v1000,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    MoveAbsJ [[9,0,0,0,30,0],none],v10\T:=2,z10,tool0;
    WaitTime 0.5;
    MoveAbsJ [[9,9,0,0,30,0],none],v10\T:=2,fine,tool0;
    TPWrite "about 4 s: "\Bool:=Abs(ClkRead(watch)-4)<0.25;       ! -> about 4 s: TRUE
  ENDPROC

  PROC there()
    FOR degrees FROM 3 TO 12 STEP 3 DO
      MoveAbsJ [[degrees,0,0,0,30,0],none],v10\T:=0.3,z10,tool0;
      WaitTime 0;
    ENDFOR
    WaitTime \InPos,0;
  ENDPROC
ENDMODULE
