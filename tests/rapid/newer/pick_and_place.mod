! RAPID Instructions, MovePnP: its parameters are not known here; it is skipped and said.
MODULE pick_and_place
  CONST robtarget p:=[[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MovePnP p,50,v1000,z10,tool0;           ! warning: R104
    TPWrite "on";                           ! -> on
  ENDPROC
ENDMODULE
