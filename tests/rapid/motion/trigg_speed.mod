! RAPID Instructions, TriggSpeed: an analog output follows the speed of the TCP from a place on.
MODULE trigg_speed
  CONST robtarget p:=[[700,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata on;
  VAR triggdata off;
  VAR triggdata look;
  VAR intnum place;

  PROC main()
    TriggSpeed on,50\Start,0,ao_flow,0.1; ! warning: I801
    TriggSpeed off,50\Start,0,ao_flow,0;
    CONNECT place WITH look_at_it;
    MoveJ p,v500,fine,tool0;
    TriggInt look,100\Start,place;
    TriggL Offs(p,0,200,0),v200,on\T2:=look,fine,tool0;
    WaitTime 0.1;
    TPWrite "stands "+NumToStr(ao_flow,1);    ! -> stands 0.0
    TriggInt look,20\Start,place;
    TriggL p,v100,off\T2:=look,z10,tool0;
    ! Off it stays on the moves that come.
    TriggL Offs(p,50,0,0),v100,look,fine,tool0;
  ENDPROC

  TRAP look_at_it
    TPWrite "here "+NumToStr(ao_flow,0);  ! -> here 20 ! -> here 10 ! -> here 0
  ENDTRAP
ENDMODULE
