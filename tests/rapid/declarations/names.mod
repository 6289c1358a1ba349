! RAPID Kernel, Scope rules: what is used is declared somewhere.
MODULE names
  VAR nmu unknown_type;           ! error: N210
  CONST robtarget pPick:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveL pPcik,v100,fine,tool0;  ! error: N201
    reg1:=missing;                ! error: N201
    WaitTmie 1;                   ! error: N209
  ENDPROC
ENDMODULE
