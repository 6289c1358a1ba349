! RAPID Instructions, TriggIO: a required argument may be given by its name, and one of two types has two names.
MODULE trigg_values_by_name
  CONST robtarget p:=[[700,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST dnum all_bits:=4294967295;
  VAR triggdata on;
  VAR triggdata equipment;
  VAR triggdata wrong;
  VAR intnum place;
  VAR dnum count:=1;

  PROC main()
    CONNECT place WITH not_so;
    TriggIO on,50\GOp:=go_all,SetDvalue:=all_bits;                 ! warning: I801
    TriggEquip equipment,20,0\GOp:=go_part,SetValue:=3;            ! warning: I801
    TriggCheckIO wrong,10,go_all,LT,CheckDvalue:=all_bits,place;
    MoveJ p,v500,fine,tool0;
    TriggL Offs(p,0,100,0),v200,on\T2:=equipment\T3:=wrong,fine,tool0;
    TPWrite ValToStr(GOutputDnum(go_all));  ! -> 4294967295
    TPWrite ValToStr(GOutput(go_part));     ! -> 3
    SetGO go_all,Dvalue:=7;
    Add Dname:=count,AddDvalue:=5;
    %"Incr"% Dname:=count;
    TPWrite ValToStr(count)+ValToStr(GOutput(go_all));  ! -> 77
  ENDPROC

  TRAP not_so
    TPWrite "not below";                    ! -> not below
  ENDTRAP
ENDMODULE
