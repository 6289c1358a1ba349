! RAPID Overview, Interrupts: traps run while the robot moves.
MODULE time_and_moves
  VAR intnum tick;
  CONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b:=[[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveAbsJ a,v1000,fine,tool0;
    CONNECT tick WITH on_tick;
    ITimer\Single,0.2,tick;
    MoveAbsJ b,v100,fine,tool0;
    TPWrite "arrived";                  ! -> arrived
  ENDPROC

  TRAP on_tick
    TPWrite "under way: "\Bool:=under_way();  ! -> under way: TRUE
  ENDTRAP

  FUNC bool under_way()
    VAR jointtarget here;
    here:=CJointT();
    RETURN here.robax.rax_1<40;
  ENDFUNC
ENDMODULE
