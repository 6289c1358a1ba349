! RAPID Instructions, SetDataSearch: the symbols of a type, one by one; SetDataVal and GetDataVal by name.
MODULE data_by_name
  PERS robtarget p1:=[[1,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num my_count1:=5;
  VAR num my_count2:=6;
  CONST num my_const:=7;
  LOCAL VAR num my_local:=8;
  VAR num other:=0;

  PROC main()
    VAR datapos block;
    VAR string name;
    VAR num value;
    VAR num three:=3;
    SetDataSearch "num"\Object:="my_.*"\InMod:="data_by_name";
    WHILE GetNextSym(name,block) DO
      GetDataVal name\Block:=block,value;
      TPWrite name+"="+ValToStr(value);     ! -> my_count1=5 ! -> my_count2=6 ! -> my_const=7 ! -> my_local=8
    ENDWHILE
    SetDataSearch "num"\Object:="my_.*"\InMod:="data_by_name"\LocalSym;
    WHILE GetNextSym(name,block) DO
      TPWrite name;                         ! -> my_local
    ENDWHILE
    SetDataSearch "num"\Object:="my_.*"\VarSym\GlobalSym;
    WHILE GetNextSym(name,block) DO
      value:=9;
      SetDataVal name\Block:=block,value;
    ENDWHILE
    TPWrite ValToStr(my_count1)+ValToStr(my_count2); ! -> 99
    SetAllDataVal "num"\TypeMod:="data_by_name"\Object:="my_count.*",three;
    GetDataVal "my_count"+ValToStr(2),value;
    TPWrite ValToStr(value);                ! -> 3
    SetDataVal "my_const",three;
    TPWrite "next";                         ! -> next
    GetDataVal "nobody",value;
    GetDataVal "p1",value;
  ERROR
    TEST ERRNO
    CASE ERR_SYM_ACCESS:
      TPWrite "access";                     ! -> access ! -> access
    CASE ERR_SYMBOL_TYPE, ERR_INVDIM:
      TPWrite "type";                       ! -> type
    CASE ERR_CALLPROC:
      TPWrite "no";
    DEFAULT:
      TPWrite "other";
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
