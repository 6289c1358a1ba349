! RAPID Instructions, AccSet: a fifth of the acceleration takes longer to reach the speed.
MODULE acc_set
  CONST robtarget p:=[[850,-200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num full;
  VAR num gentle;

  PROC main()
    ConfL \Off;
    ConfJ \Off;
    MoveJ p,v500,fine,tool0;
    ! Once before, for the robot goes on sooner where it has not moved.
    full:=took();
    full:=took();
    AccSet 20,20;
    gentle:=took();
    AccSet 100,100;
    TPWrite "slower: "\Bool:=gentle>full+0.1;       ! -> slower: TRUE
    TPWrite "and back: "\Bool:=Abs(took()-full)<0.001;  ! -> and back: TRUE
  ENDPROC

  FUNC num took()
    VAR clock watch;
    MoveL p,v1000,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    MoveL Offs(p,0,400,0),v1000,fine,tool0;
    ClkStop watch;
    RETURN ClkRead(watch);
  ENDFUNC
ENDMODULE
