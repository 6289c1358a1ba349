! RAPID Instructions, TriggIO: SetDvalue and CheckDvalue take groups of more bits than a num holds.
MODULE trigg_values_of_dnum
  CONST robtarget p:=[[700,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST dnum all_bits:=4294967295;
  VAR triggdata on;
  VAR triggdata right;
  VAR triggdata wrong;
  VAR intnum place;

  PROC main()
    CONNECT place WITH not_so;
    TriggIO on,50\GOp:=go_all,all_bits;         ! warning: I801
    TriggCheckIO right,20,go_all,EQ,all_bits,place;
    TriggCheckIO wrong,10,go_all,LT,all_bits,place;
    MoveJ p,v500,fine,tool0;
    TriggL Offs(p,0,100,0),v200,on\T2:=right\T3:=wrong,fine,tool0;
    TPWrite ValToStr(GOutputDnum(go_all));      ! -> 4294967295
  ENDPROC

  TRAP not_so
    TPWrite "not below "+NumToStr(Distance(CPos(),p.trans),0); ! -> not below 90
  ENDTRAP
ENDMODULE
